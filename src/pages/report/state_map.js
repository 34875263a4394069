// Draws states along a line over time (StateMap of picture.hpp): a coloured cell for each place and instant.
// @param page  what page.js shares: css, number, even, save, file_name, pixels, button
function damslip_state_map(figure, map, page) {
    "use strict";
    const place = figure.querySelector(".canvas"), reading = figure.querySelector(".reading");
    const canvas = document.createElement("canvas");
    const expand = runs => runs.replace(/(\d+)(\D)/g, (_, n, letter) => letter.repeat(Number(n)));
    const rows = map.states.map(expand), n = rows.length, m = map.distance.length;
    const kind = Object.fromEntries(map.kinds.map((k, i) => [k.letter, i])); // the later of two shows in a common pixel
    const kind_colour = k => k.colour < 0 ? page.css("--calm") : page.css("--c" + k.colour);
    // Beside its colour each kind has a pattern: plain, stripes, dots.
    const pattern_of = k => k.colour < 0 ? 0 : map.kinds.filter(o => o.colour >= 0).indexOf(k) % 3;
    // A place reaches half-way to its neighbours.
    const edge = i => i <= 0 ? map.distance[0] : i >= m ? map.distance[m - 1] : (map.distance[i - 1] + map.distance[i]) / 2;
    const low = edge(0), high = edge(m), start = map.time[0], end = map.time[n - 1];
    let box = null, picture = null, cursor = null;

    const legend = document.createElement("ul");
    legend.className = "swatches";
    place.after(legend);

    function draw_legend() {
        legend.textContent = "";
        for (const k of map.kinds.filter(k => map.states.some(runs => runs.includes(k.letter)))) {
            const item = document.createElement("li"), swatch = document.createElement("span");
            const pattern = pattern_of(k), colour = kind_colour(k), paper = page.css("--paper");
            swatch.style.background = pattern === 1 ? `repeating-linear-gradient(135deg, ${paper} 0 1.5px, ${colour} 1.5px 5px)`
                                    : pattern === 2 ? `radial-gradient(circle, ${paper} 1.2px, ${colour} 1.4px) 0 0 / 5px 5px` : colour;
            item.append(swatch, k.name);
            legend.append(item);
        }
    }

    const to_x = t => box.left + (t - start) / (end - start || 1) * box.width;
    const to_y = d => box.top + (high - d) / (high - low || 1) * box.height;

    // One pixel column for each column of the screen; of the instants in it the most notable state.
    function cells(width, height, r) {
        const image = document.createElement("canvas");
        image.width = width; image.height = height;
        const ctx = image.getContext("2d"), data = ctx.createImageData(width, height);
        const rgb = c => [1, 3, 5].map(i => parseInt(c.slice(i, i + 2), 16));
        const of_kind = map.kinds.map(k => rgb(kind_colour(k))), of_paper = rgb(page.css("--paper")), patterns = map.kinds.map(pattern_of);
        const in_pattern = [() => false, (x, y) => (x + y) % 6 < 1.5, (x, y) => x % 5 < 1.6 && y % 5 < 1.6]; // in pixels of the page
        const place_of = Array.from({length: height}, (_, y) => {
            const d = high - (y + 0.5) / height * (high - low);
            let i = 0;
            while (i < m - 1 && edge(i + 1) < d) ++i;
            return i;
        });
        const tops = new Array(m);
        for (let x = 0; x < width; ++x) {
            const from = Math.floor(x * n / width), to = Math.max(from + 1, Math.floor((x + 1) * n / width));
            for (let i = 0; i < m; ++i) {
                tops[i] = 0;
                for (let k = from; k < to && k < n; ++k) tops[i] = Math.max(tops[i], kind[rows[k][i]] ?? 0);
            }
            for (let y = 0; y < height; ++y) {
                const top = tops[place_of[y]];
                data.data.set([...(in_pattern[patterns[top]](x / r, y / r) ? of_paper : of_kind[top]), 255], (y * width + x) * 4);
            }
        }
        ctx.putImageData(data, 0, 0);
        return image;
    }

    function axes(ctx, width, height) {
        ctx.font = "12px system-ui, sans-serif";
        ctx.fillStyle = ctx.strokeStyle = page.css("--axis");
        ctx.textAlign = "center"; ctx.textBaseline = "top";
        for (const t of page.even(start, end, Math.max(2, box.width / 80))) {
            ctx.fillText(page.number(t), to_x(t), box.top + box.height + 6);
            ctx.fillRect(to_x(t), box.top + box.height, 1, 4);
        }
        ctx.fillText("time (s)", box.left + box.width / 2, height - 15);
        ctx.textAlign = "right"; ctx.textBaseline = "middle";
        for (const d of page.even(low, high, 5)) {
            ctx.fillText(page.number(d), box.left - 7, to_y(d));
            ctx.fillRect(box.left - 4, to_y(d), 4, 1);
        }
        ctx.save();
        ctx.translate(12, box.top + box.height / 2); ctx.rotate(-Math.PI / 2); ctx.textAlign = "center";
        ctx.fillText("distance " + map.place + " (m)", 0, 0);
        ctx.restore();
        ctx.strokeRect(box.left - 0.5, box.top - 0.5, box.width + 1, box.height + 1);
    }

    function paint() {
        const r = window.devicePixelRatio, ctx = canvas.getContext("2d");
        ctx.setTransform(r, 0, 0, r, 0, 0);
        ctx.fillStyle = page.css("--paper");
        ctx.fillRect(0, 0, canvas.width / r, canvas.height / r);
        ctx.imageSmoothingEnabled = false;
        ctx.drawImage(picture, box.left, box.top, box.width, box.height);
        axes(ctx, canvas.width / r, canvas.height / r);
        if (!cursor) return;
        ctx.fillStyle = page.css("--ink");
        ctx.fillRect(to_x(map.time[cursor.row]), box.top, 1, box.height);
        ctx.fillRect(box.left, to_y(map.distance[cursor.pair]), box.width, 1);
    }

    function draw() {
        const width = Math.floor(place.clientWidth), height = document.documentElement.classList.contains("paper") ? 215 : 260, r = window.devicePixelRatio;
        if (!width) return false;
        box = {left: 58, top: 8, width: width - 72, height: height - 52};
        canvas.width = width * r; canvas.height = height * r;
        canvas.style.width = width + "px"; canvas.style.height = height + "px";
        if (!canvas.parentNode) place.append(canvas);
        picture = cells(Math.max(1, Math.round(box.width * r)), Math.round(box.height * r), r);
        draw_legend();
        paint();
        return true;
    }

    function read(row, pair) {
        cursor = {row: Math.max(0, Math.min(n - 1, row)), pair: Math.max(0, Math.min(m - 1, pair))};
        paint();
        reading.textContent = page.number(map.time[cursor.row]) + " s, " + page.number(map.distance[cursor.pair]) + " m " +
            map.place + ": " + map.kinds[kind[rows[cursor.row][cursor.pair]] ?? 0].name;
    }
    const nearest = (list, v) => {
        let best = 0;
        list.forEach((x, i) => { if (Math.abs(x - v) < Math.abs(list[best] - v)) best = i; });
        return best;
    };
    canvas.addEventListener("pointermove", e => {
        const t = start + (e.offsetX - box.left) / box.width * (end - start), d = high - (e.offsetY - box.top) / box.height * (high - low);
        read(nearest(map.time, t), nearest(map.distance, d));
    });
    place.addEventListener("keydown", e => {
        const stride = e.shiftKey ? Math.max(1, Math.round(n / 20)) : 1, at = cursor ?? {row: 0, pair: 0};
        const move = {ArrowLeft: [-stride, 0], ArrowRight: [stride, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[e.key];
        if (!move) return;
        e.preventDefault();
        read(at.row + move[0], at.pair + move[1]);
    });

    const csv = () => "time (s)," + map.distance.map(d => d + " m").join(",") + "\n" +
        rows.map((row, i) => map.time[i] + "," + [...row].join(",")).join("\n") + "\n";
    page.button("CSV", "Save the states", () => page.save(page.file_name(map.title) + ".csv", new Blob([csv()], {type: "text/csv"})));
    page.button("PNG", "Save the picture", () => canvas.toBlob(blob => page.save(page.file_name(map.title) + ".png", blob)));

    return {
        draw,
        // Any cell that is not calm, or calm cells throughout: the picture has the colours of its states.
        is_empty: () => {
            const r = window.devicePixelRatio;
            const pixels = page.pixels(canvas, box.left * r, box.top * r, box.width * r, box.height * r);
            const wanted = map.kinds.map(k => { const c = kind_colour(k); return [1, 3, 5].map(i => parseInt(c.slice(i, i + 2), 16)).join(); });
            for (let i = 0; i < pixels.length; i += 4)
                if (wanted.includes(pixels[i] + "," + pixels[i + 1] + "," + pixels[i + 2])) return false;
            return true;
        },
    };
}
