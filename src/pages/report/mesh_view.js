// Draws a mesh in several states, deformed, with contours of a field in bands of equal width (MeshView of picture.hpp).
// @param page  what page.js shares: css, number, even, save, file_name, pixels, button
function damslip_mesh_view(figure, view, page) {
    "use strict";
    const place = figure.querySelector(".canvas"), reading = figure.querySelector(".reading");
    const canvas = document.createElement("canvas");
    const decimals = list => list.n.map(v => v == null ? null : v * list.unit);
    for (const s of view.states) {
        s.ux = decimals(s.ux); s.uy = decimals(s.uy);
        s.values = s.values.map(decimals);
    }
    const nodes = view.x.length, count = view.elements.length / 4;
    const element = e => view.elements.slice(4 * e, 4 * e + 4).filter(node => node >= 0);
    const elements = Array.from({length: count}, (_, e) => element(e));
    // During the earthquake: for each node the largest value (of a field that is `least`, the smallest) of all states, and which state it is of.
    const shaken = view.states.slice(1);
    const envelope = shaken.length < 2 ? null : {name: "envelope of the " + shaken.length + " instants", shift: [0, 0], ux: Array(nodes).fill(0), uy: Array(nodes).fill(0)};
    if (envelope) {
        envelope.of = view.fields.map((field, f) => Array.from({length: nodes}, (_, i) => shaken.reduce((best, s) =>
            (field.least ? s.values[f][i] < best.values[f][i] : s.values[f][i] > best.values[f][i]) ? s : best)));
        envelope.values = view.fields.map((_, f) => envelope.of[f].map((s, i) => s.values[f][i]));
    }
    const signed_colours = ["#053061", "#2166ac", "#4393c3", "#92c5de", "#d1e5f0", "#f7f7f7", "#fddbc7", "#f4a582", "#d6604d", "#b2182b", "#67001f"];
    const plain_colours = ["#fffbe6", "#fee6a8", "#fdc06a", "#fb8b3c", "#e4502a", "#b91f26", "#6d0a1f"];

    // ---- what does not change ---------------------------------------------------------------------------------------
    const extent = (from, to) => {
        const b = {x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity};
        for (let i = from; i < to; ++i) {
            b.x0 = Math.min(b.x0, view.x[i]); b.x1 = Math.max(b.x1, view.x[i]);
            b.y0 = Math.min(b.y0, view.y[i]); b.y1 = Math.max(b.y1, view.y[i]);
        }
        return b;
    };
    const front = extent(0, view.front), all = extent(0, nodes), size = Math.max(front.x1 - front.x0, front.y1 - front.y0);
    const nice = v => { const p = Math.pow(10, Math.floor(Math.log10(v))); return p * [1, 2, 2.5, 5, 10].find(k => k * p >= v * 0.999); };

    // Edges of one element only: the outline of the bodies.
    const outline = (() => {
        const seen = new Map();
        for (const e of elements)
            e.forEach((a, i) => {
                const b = e[(i + 1) % e.length], key = a < b ? a + "_" + b : b + "_" + a;
                seen.set(key, seen.has(key) ? null : [a, b]);
            });
        return [...seen.values()].filter(Boolean);
    })();

    const largest = Math.max(1e-12, ...view.states.map(s => {
        let d = 0;
        for (let i = 0; i < view.front; ++i) d = Math.max(d, Math.hypot(s.ux[i], s.uy[i]));
        return d;
    }));
    const natural = nice(0.05 * size / largest) || 1; // magnification

    // Bands: the same in all states, from the values of the front body without its most extreme hundredth, which are
    // those of re-entrant corners and grow with every finer mesh.
    const bands = view.fields.map((_, f) => {
        const values = view.states.flatMap(s => s.values[f].slice(0, view.front)).filter(v => v != null).sort((a, b) => a - b);
        const at = q => values[Math.round(q * (values.length - 1))] ?? 0;
        const signed = at(0.01) < -0.01 * Math.abs(at(0.99));
        const reach = Math.max(Math.abs(at(0.01)), Math.abs(at(0.99))) || 1;
        const step = nice(reach / (signed ? 7 : 10));
        const low = signed ? Math.floor(at(0.01) / step) : 0, high = Math.max(low + 1, Math.ceil(at(0.99) / step));
        const span = Math.max(Math.abs(low), Math.abs(high));
        const colour = k => { // band from k step to (k+1) step
            const q = signed ? (k + 0.5) / span * 0.5 + 0.5 : (k + 0.5) / high, list = signed ? signed_colours : plain_colours;
            const p = Math.max(0, Math.min(1, q)) * (list.length - 1), i = Math.min(list.length - 2, Math.floor(p)), w = p - i;
            const mix = at => Math.round(parseInt(list[i].slice(at, at + 2), 16) * (1 - w) + parseInt(list[i + 1].slice(at, at + 2), 16) * w);
            return "rgb(" + mix(1) + "," + mix(3) + "," + mix(5) + ")";
        };
        return {step, low, high, colours: Array.from({length: high - low}, (_, k) => colour(low + k))};
    });

    // ---- controls ---------------------------------------------------------------------------------------------------
    const controls = document.createElement("div");
    controls.className = "controls";
    place.before(controls);
    function labelled(text, input) {
        const label = document.createElement("label"), out = document.createElement("output");
        label.append(text + " ", input, out);
        controls.append(label);
        input.addEventListener("input", () => { show(); paint(); });
        return {input, out};
    }
    function range(text, max, step, value) {
        const input = document.createElement("input");
        Object.assign(input, {type: "range", min: 0, max, step, value});
        return labelled(text, input);
    }
    function choice(text, names) {
        const input = document.createElement("select");
        names.forEach((name, i) => input.add(new Option(name, i)));
        return labelled(text, input);
    }
    const highest = s => Math.max(...s.values[0].slice(0, view.front));
    const worst = shaken.reduce((w, s) => highest(s) > highest(w) ? s : w, shaken[0] ?? view.states[0]);
    const state_slider = range("State", view.states.length - 1, 1, view.states.indexOf(worst));
    const field_choice = choice("Shown", view.fields.map(f => f.name));
    const part_choice = choice("Part", all.x1 - all.x0 > 1.01 * (front.x1 - front.x0) ? ["dam", "whole model"] : ["dam"]);
    const magnifier = range("Deformation", 2, 0.1, 1);
    const mesh_box = document.createElement("input");
    mesh_box.type = "checkbox"; mesh_box.checked = true;
    labelled("Mesh", mesh_box);

    const state = () => view.states[Number(state_slider.input.value)] ?? envelope;
    const magnification = () => natural * Number(magnifier.input.value);
    const state_name = s => s.name + (s === envelope ? "" : ", " + page.number(s.time) + " s");
    function show() {
        // Where there is room for one panel only, the envelope is the last state.
        state_slider.input.max = view.states.length - (envelope && !divided(canvas.width / window.devicePixelRatio) ? 0 : 1);
        state_slider.out.textContent = state_name(state());
        state_slider.input.setAttribute("aria-valuetext", state_name(state()));
        magnifier.out.textContent = "× " + page.number(magnification(), 3);
    }

    // ---- drawing ----------------------------------------------------------------------------------------------------
    // One panel, or two beside each other: the chosen state, and the envelope.
    const head = 52; // of a panel: its name and extremes [px]
    let panels = [], frame = null, px = [], py = [];
    const divided = width => envelope && part_choice.input.value === "0" && width >= 560;
    function fit(left, width, height) {
        const whole = part_choice.input.value === "1", b = whole ? all : front, margin = (whole ? 0.03 : 0.14) * size;
        const scale = Math.min(width / (b.x1 - b.x0 + 2 * margin), (height - head) / (b.y1 - b.y0 + 2 * margin));
        frame = {scale, from: left, left: left + width / 2 - scale * (b.x0 + b.x1) / 2, top: (height + head) / 2 + scale * (b.y0 + b.y1) / 2, width, height};
    }
    function place_nodes(s) {
        const mag = magnification();
        px = new Float64Array(nodes); py = new Float64Array(nodes);
        for (let i = 0; i < nodes; ++i) {
            const shift = i < view.front ? s.shift : [0, 0];
            px[i] = frame.left + frame.scale * (view.x[i] + shift[0] + mag * s.ux[i]);
            py[i] = frame.top - frame.scale * (view.y[i] + shift[1] + mag * s.uy[i]);
        }
    }
    const outside = e => e.every(i => px[i] < frame.from) || e.every(i => px[i] > frame.from + frame.width) || e.every(i => py[i] < 0) || e.every(i => py[i] > frame.height);

    // Part of a convex polygon of [x, y, value] on one side of a value.
    function cut(polygon, value, side) {
        const out = [];
        polygon.forEach((a, i) => {
            const b = polygon[(i + 1) % polygon.length], da = side * (a[2] - value), db = side * (b[2] - value);
            if (da >= 0) out.push(a);
            if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
                const q = da / (da - db);
                out.push([a[0] + q * (b[0] - a[0]), a[1] + q * (b[1] - a[1]), value]);
            }
        });
        return out;
    }
    function trace(path, polygon) {
        polygon.forEach((p, i) => i ? path.lineTo(p[0], p[1]) : path.moveTo(p[0], p[1]));
        path.closePath();
    }
    function contours(ctx, f, s) {
        const {step, low, high, colours} = bands[f], values = s.values[f], paths = colours.map(() => new Path2D());
        const band = v => Math.max(0, Math.min(high - low - 1, Math.floor(v / step) - low));
        for (const e of elements) {
            if (outside(e)) continue;
            const ring = e.map(i => [px[i], py[i], values[i] ?? 0]);
            const first = band(ring[0][2]);
            if (ring.every(p => band(p[2]) === first)) { trace(paths[first], ring); continue; }
            const centre = [0, 1, 2].map(k => ring.reduce((sum, p) => sum + p[k], 0) / ring.length);
            ring.forEach((a, i) => {
                const corner = [a, ring[(i + 1) % ring.length], centre], bs = corner.map(p => band(p[2]));
                for (let b = Math.min(...bs); b <= Math.max(...bs); ++b) {
                    let part = corner;
                    if (b > 0) part = cut(part, (low + b) * step, 1);
                    if (b < high - low - 1) part = cut(part, (low + b + 1) * step, -1);
                    if (part.length > 2) trace(paths[b], part);
                }
            });
        }
        ctx.lineWidth = 0.7; // closes the seams between neighbours
        paths.forEach((path, k) => { ctx.fillStyle = ctx.strokeStyle = colours[k]; ctx.fill(path); ctx.stroke(path); });
    }
    function lines(ctx) {
        const path = new Path2D();
        for (const e of elements) if (!outside(e)) trace(path, e.map(i => [px[i], py[i]]));
        ctx.strokeStyle = "#00000040"; ctx.lineWidth = 0.5;
        ctx.stroke(path);
    }
    function outlines(ctx) {
        const bodies = new Path2D(), rest = new Path2D();
        for (const [a, b] of outline) {
            bodies.moveTo(px[a], py[a]); bodies.lineTo(px[b], py[b]);
            if (a >= view.front) continue;
            rest.moveTo(frame.left + frame.scale * view.x[a], frame.top - frame.scale * view.y[a]);
            rest.lineTo(frame.left + frame.scale * view.x[b], frame.top - frame.scale * view.y[b]);
        }
        ctx.strokeStyle = page.css("--ink"); ctx.lineWidth = 1.1;
        ctx.stroke(bodies);
        ctx.setLineDash([4, 4]); ctx.lineWidth = 0.9; ctx.strokeStyle = page.css("--muted");
        ctx.stroke(rest);
        ctx.setLineDash([]);
    }
    function haloed(ctx, text, x, y) {
        ctx.lineWidth = 4; ctx.lineJoin = "round"; ctx.strokeStyle = page.css("--paper");
        ctx.strokeText(text, x, y);
        ctx.fillStyle = page.css("--ink");
        ctx.fillText(text, x, y);
    }
    // Largest and smallest value of the front body: place and time above the picture, marked in it beside the body.
    function extremes(ctx, f, s) {
        const values = s.values[f].slice(0, view.front);
        const middle = y => { // of the body at this elevation
            const beside = view.x.slice(0, view.front).filter((_, i) => Math.abs(view.y[i] - y) < 0.03 * size);
            return (Math.min(...beside) + Math.max(...beside)) / 2;
        };
        let high = 0, low = 0;
        values.forEach((v, i) => { if (v > values[high]) high = i; if (v < values[low]) low = i; });
        const shown = s !== envelope ? [[high, "max"], [low, "min"]] : view.fields[f].least ? [[low, "min"]] : [[high, "max"]];
        ctx.font = "12px system-ui, sans-serif"; ctx.textBaseline = "middle"; ctx.textAlign = "left";
        ctx.fillStyle = page.css("--ink");
        ctx.fillText(state_name(s), frame.from + 6, 10, frame.width - 12);
        let last = null;
        shown.forEach(([i, word], k) => {
            const time = s === envelope ? ", " + page.number(s.of[f][i].time, 4) + " s" : "";
            ctx.textAlign = "left"; ctx.fillStyle = page.css("--ink");
            ctx.fillText(word + " " + page.number(values[i], 3) + " " + view.fields[f].unit + " at x " + page.number(view.x[i], 3) + ", y " + page.number(view.y[i], 3) + " m" + time,
                         frame.from + 6, 26 + 16 * k, frame.width - 12);
            ctx.beginPath(); ctx.arc(px[i], py[i], 3, 0, 7); ctx.fill();
            const right = view.x[i] > middle(view.y[i]), close = last && Math.abs(py[i] - last.y) < 14 && right === last.right;
            const y = close ? last.y - 14 : py[i] - 6;
            ctx.textAlign = right ? "left" : "right";
            haloed(ctx, word, px[i] + (right ? 8 : -8), y);
            last = {y, right};
        });
    }
    function colour_bar(ctx, f, top) {
        const {step, low, high, colours} = bands[f], field = view.fields[f];
        const whole = canvas.width / window.devicePixelRatio, width = Math.min(420, whole - 40), left = (whole - width) / 2, cell = width / colours.length;
        colours.forEach((c, k) => { ctx.fillStyle = c; ctx.fillRect(left + k * cell, top + 20, cell + 0.5, 13); });
        ctx.strokeStyle = page.css("--axis"); ctx.lineWidth = 1; ctx.strokeRect(left, top + 20, width, 13);
        ctx.fillStyle = page.css("--ink"); ctx.font = "12px system-ui, sans-serif"; ctx.textAlign = "center";
        ctx.textBaseline = "top";
        ctx.fillText(field.name + (field.unit ? " (" + field.unit + ")" : ""), whole / 2, top + 2);
        const every = Math.max(1, Math.ceil(colours.length * 42 / width));
        for (let k = low; k <= high; ++k)
            if (k % every === 0) ctx.fillText(page.number(k * step), left + (k - low) * cell, top + 37);
    }
    function paint() {
        const r = window.devicePixelRatio, ctx = canvas.getContext("2d"), bar = 56, f = Number(field_choice.input.value);
        const width = canvas.width / r, height = canvas.height / r;
        ctx.setTransform(r, 0, 0, r, 0, 0);
        ctx.fillStyle = page.css("--paper");
        ctx.fillRect(0, 0, width, height);
        const shown = divided(width) ? [state(), envelope] : [state()], wide = width / shown.length;
        panels = shown.map((s, k) => {
            fit(k * wide, wide, height - bar);
            place_nodes(s);
            ctx.save();
            ctx.beginPath(); ctx.rect(frame.from, 0, wide, height - bar); ctx.clip();
            contours(ctx, f, s);
            if (mesh_box.checked) lines(ctx);
            outlines(ctx);
            extremes(ctx, f, s);
            ctx.restore();
            return {s, px, py};
        });
        colour_bar(ctx, f, height - bar);
    }
    function draw() {
        const width = Math.floor(place.clientWidth), r = window.devicePixelRatio;
        if (!width) return false;
        const on_paper = document.documentElement.classList.contains("paper");
        const height = Math.round(Math.min(on_paper ? 460 : 620, Math.max(360, 1.05 * width)));
        canvas.width = width * r; canvas.height = height * r;
        canvas.style.width = width + "px"; canvas.style.height = height + "px";
        if (!canvas.parentNode) place.append(canvas);
        show();
        paint();
        return true;
    }

    canvas.addEventListener("pointermove", e => {
        let best = -1, distance = 20, s = null;
        for (const panel of panels)
            for (let i = 0; i < nodes; ++i) {
                const d = Math.hypot(panel.px[i] - e.offsetX, panel.py[i] - e.offsetY);
                if (d < distance) { best = i; distance = d; s = panel.s; }
            }
        if (best < 0) { reading.textContent = ""; return; }
        const f = Number(field_choice.input.value);
        reading.textContent = "x " + page.number(view.x[best], 4) + " m, y " + page.number(view.y[best], 4) + " m: " +
            view.fields[f].name + " " + page.number(s.values[f][best], 4) + " " + view.fields[f].unit + (s === envelope ? ", " + state_name(s.of[f][best]) : "");
    });
    place.addEventListener("keydown", e => {
        const step = {ArrowLeft: -1, ArrowRight: 1}[e.key];
        if (!step) return;
        e.preventDefault();
        state_slider.input.value = Number(state_slider.input.value) + step;
        show(); paint();
        reading.textContent = state_name(state());
    });

    function csv() {
        const head = ["state", "time (s)", "node", "x (m)", "y (m)", "u_x (m)", "u_y (m)", ...view.fields.map(f => f.name + " (" + f.unit + ")")];
        const out = [head.map(h => /[",]/.test(h) ? '"' + h.replace(/"/g, '""') + '"' : h).join(",")];
        for (const s of view.states)
            for (let i = 0; i < nodes; ++i) {
                const shift = i < view.front ? s.shift : [0, 0];
                out.push(['"' + s.name.replace(/"/g, '""') + '"', s.time, i, view.x[i], view.y[i], Number((s.ux[i] + shift[0]).toPrecision(5)), Number((s.uy[i] + shift[1]).toPrecision(5)),
                          ...s.values.map(v => v[i] == null ? "" : Number(v[i].toPrecision(5)))].join(","));
            }
        return out.join("\n") + "\n";
    }
    page.button("CSV", "Save displacements and stresses of all states", () => page.save(page.file_name(view.title) + ".csv", new Blob([csv()], {type: "text/csv"})));
    page.button("PNG", "Save the picture", () => canvas.toBlob(blob => page.save(page.file_name(view.title) + ".png", blob)));

    return {
        draw,
        // Empty without two colours of the bands.
        is_empty: () => {
            const f = Number(field_choice.input.value), r = window.devicePixelRatio;
            const pixels = page.pixels(canvas, 0, 0, canvas.width, canvas.height - Math.round(56 * r));
            const wanted = new Set(bands[f].colours.map(c => c.slice(4, -1))), found = new Set();
            for (let i = 0; i < pixels.length && found.size < 2; i += 4) {
                const c = pixels[i] + "," + pixels[i + 1] + "," + pixels[i + 2];
                if (wanted.has(c)) found.add(c);
            }
            return found.size < 2;
        },
    };
}
