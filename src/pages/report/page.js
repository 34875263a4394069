// Draws the charts of a report page. Each figure.chart holds its data as JSON (chart_data.cpp) and a place to draw in.
"use strict";
(() => {
    const errors = [];
    window.addEventListener("error", e => { errors.push(e.message); mark(); });

    // Canvases are drawn at twice the screen's pixels at least, so that they print sharply.
    if (window.devicePixelRatio < 2) {
        Object.defineProperty(window, "devicePixelRatio", {value: 2, configurable: true});
        window.dispatchEvent(new Event("resize"));
    }

    const root = document.documentElement;
    const dark_wanted = matchMedia("(prefers-color-scheme: dark)");
    const print_wanted = matchMedia("print");
    let chosen = null; // "dark" or "light" once the reader has pressed the button

    function set_theme() {
        root.classList.toggle("dark", !printing && (chosen ? chosen === "dark" : dark_wanted.matches));
    }
    let printing = false;
    set_theme();

    const css = name => getComputedStyle(root).getPropertyValue(name).trim();
    const colour = k => css("--c" + (k % 8));

    // ---- numbers -------------------------------------------------------------------------------------------------
    function number(v, digits = 5) {
        if (v == null || !isFinite(v)) return "–";
        if (v === 0) return "0";
        const a = Math.abs(v);
        const s = a >= 1e7 || a < 1e-4 ? v.toExponential(digits - 1) : String(Number(v.toPrecision(digits)));
        return s.replace("-", "−");
    }

    function tick_text(v, step) {
        if (v == null) return "";
        if (v === 0) return "0";
        const a = Math.abs(v);
        if (a >= 1e6 || a < 1e-4) return v.toExponential(2).replace(/\.?0+e/, "e").replace("-", "−").replace("e+", "e");
        const decimals = step ? Math.max(0, Math.min(8, -Math.floor(Math.log10(step) + 1e-9))) : undefined;
        return (decimals === undefined ? String(Number(v.toPrecision(3))) : v.toFixed(decimals)).replace("-", "−");
    }

    const with_unit = axis => axis.label + (axis.unit && axis.unit !== "–" ? " (" + axis.unit + ")" : "");

    const measure = document.createElement("canvas").getContext("2d");
    function text_width(words) { // at 12 px
        measure.font = "12px system-ui, sans-serif";
        return measure.measureText(words).width;
    }

    // ---- scales and ticks -------------------------------------------------------------------------------------------
    // Ticks at 0 and 1, 2, 5 times powers of ten where there is room; evenly spaced ones in a narrow part of a scale.
    function decades(low, high, from, most) {
        const first = Math.floor(Math.log10(from)), last = Math.ceil(Math.log10(Math.max(Math.abs(low), Math.abs(high), from)));
        const all = steps => {
            const found = [];
            for (const sign of [-1, 1])
                for (let e = first; e <= last; ++e)
                    for (const m of steps) {
                        const v = sign * Number((m * Math.pow(10, e)).toPrecision(3));
                        if (v >= low && v <= high) found.push(v);
                    }
            return found;
        };
        let ticks = all([1, 2, 5]);
        if (ticks.length > most) ticks = all([1]);
        if (low <= 0 && high >= 0) ticks.push(0);
        ticks.sort((a, b) => a - b);
        return ticks.length >= 2 ? ticks : even(low, high, 4);
    }
    function even(low, high, n) {
        const raw = (high - low) / n, power = Math.pow(10, Math.floor(Math.log10(raw)));
        const step = power * [1, 2, 5, 10].find(m => m * power >= raw * 0.999);
        const ticks = [];
        for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(Number((k * step).toPrecision(12)));
        return ticks;
    }

    function value_range(axis, extra) {
        return (u, low, high) => {
            if (low == null) { low = 0; high = 1; }
            for (const v of extra) { low = Math.min(low, v); high = Math.max(high, v); }
            if (axis.scale === "log") {
                if (!(low > 0)) low = high > 0 ? high / 10 : 0.1;
                low = Math.pow(10, Math.floor(Math.log10(low) * 5 - 0.2) / 5);
                high = Math.pow(10, Math.ceil(Math.log10(Math.max(high, low * 1.5)) * 5 + 0.2) / 5);
            } else if (axis.scale === "asinh") {
                const t = axis.linear_below, out = v => t * Math.sinh(Math.asinh(v / t) * 1.08);
                high = high > 0 ? Math.max(out(high), 2 * t) : t;
                low = low < 0 ? out(low) : -t * Math.sinh(0.02 * Math.asinh(high / t)); // a curve at zero stays clear of the edge
            } else {
                if (low === 0 && high === 0) high = 1;
                const pad = (high - low || Math.abs(high)) * 0.06;
                low -= low === 0 ? pad / 3 : pad;
                high += high === 0 ? pad / 3 : pad;
            }
            return [axis.low ?? low, axis.high ?? high];
        };
    }

    // ---- one chart ----------------------------------------------------------------------------------------------------
    function abscissae(x) {
        if (Array.isArray(x)) return x;
        return Array.from({length: x.n}, (_, i) => Number((x.from + i * x.step).toPrecision(9)));
    }

    function in_box(u, paint) {
        const ctx = u.ctx, box = u.bbox;
        ctx.save();
        ctx.beginPath();
        ctx.rect(box.left, box.top, box.width, box.height);
        ctx.clip();
        paint(ctx, uPlot.pxRatio, box);
        ctx.restore();
    }

    const crowded = new Set(); // labels that cover each other, or are cut off
    // Lines across the chart with their labels, below the curves. A label stands where it covers no other label and least of the curves.
    function draw_lines(chart) {
        return u => in_box(u, (ctx, r, box) => {
            const placed = [], drawn = [], high = 15 * r, gap = 5 * r;
            ctx.font = 12 * r + "px system-ui, sans-serif";
            ctx.textAlign = "left"; ctx.textBaseline = "middle";
            const meets = (a, b) => a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h && b.y < a.y + a.h;
            const covered = place => u.data.slice(1).reduce((sum, y, k) => sum + (u.series[k + 1].show && u.series[k + 1].class !== "helper" ?
                [0, 0.25, 0.5, 0.75, 1].filter(q => {
                    const x = u.posToVal((place.x + q * place.w - box.left) / r, "x"), i = u.valToIdx(x), j = x < u.data[0][i] ? i - 1 : i + 1;
                    const v = j < 0 || j >= y.length || y[i] == null || y[j] == null ? y[i]
                            : y[i] + (y[j] - y[i]) * (x - u.data[0][i]) / (u.data[0][j] - u.data[0][i] || 1);
                    const at = v == null ? NaN : u.valToPos(v, "y", true);
                    return at > place.y && at < place.y + place.h;
                }).length : 0), 0);
            const label = (words, places) => {
                const w = ctx.measureText(words).width, inside = p => p.y >= box.top && p.y + p.h <= box.top + box.height;
                const free = places.map(([x, y, turned]) => turned ? {x: x(high), y, w: high, h: w, turned}
                    : {x: Math.max(box.left + gap, Math.min(box.left + box.width - w - gap, x(w))), y, w, h: high}).filter(inside);
                const cost = p => 100 * placed.filter(o => meets(p, o)).length + 4 * drawn.filter(o => meets(p, o)).length + 3 * covered(p);
                const best = free.reduce((a, p) => a && cost(a) <= cost(p) ? a : p, null);
                if (!best || cost(best) >= 100) crowded.add(chart.title + ": " + words);
                if (!best) return;
                placed.push(best);
                ctx.save();
                ctx.translate(best.x + (best.turned ? high / 2 : 0), best.y + (best.turned ? w : high / 2));
                if (best.turned) ctx.rotate(-Math.PI / 2);
                ctx.setLineDash([]);
                ctx.lineWidth = 4 * r; ctx.strokeStyle = css("--paper");
                ctx.strokeText(words, 0, 0);
                ctx.fillStyle = css("--mark");
                ctx.fillText(words, 0, 0);
                ctx.restore();
            };
            const line = (x0, y0, x1, y1) => {
                ctx.lineWidth = 1.3 * r; ctx.strokeStyle = css("--mark"); ctx.setLineDash([6 * r, 4 * r]);
                ctx.beginPath(); ctx.moveTo(x0, y0); ctx.lineTo(x1, y1); ctx.stroke();
            };
            const horizontal = chart.horizontal.map(l => ({label: l.label, y: u.valToPos(l.at, "y", true)}));
            const vertical = chart.vertical.map(l => ({label: l.label, x: u.valToPos(l.at, "x", true)}))
                .filter(l => l.x >= box.left && l.x <= box.left + box.width);
            for (const l of horizontal) line(box.left, l.y, box.left + box.width, l.y);
            for (const l of vertical) line(l.x, box.top, l.x, box.top + box.height);
            for (const l of horizontal) drawn.push({x: box.left, y: l.y - r, w: box.width, h: 2 * r});
            for (const l of vertical) drawn.push({x: l.x - r, y: box.top, w: 2 * r, h: box.height});
            for (const l of horizontal)
                label(l.label, [0.98, 0.02, 0.75, 0.5, 0.25].flatMap(q => [l.y - high - 2 * r, l.y + 2 * r].map(y => [w => box.left + q * (box.width - w), y])));
            for (const l of vertical)
                label(l.label, [false, true].flatMap(turned => [...Array(Math.floor(box.height / high)).keys()].flatMap(k =>
                    [w => l.x + gap, w => l.x - w - gap].map(x => [x, box.top + 3 * r + k * high, turned]))));
        });
    }

    // The bars around points.
    function draw_bars(helpers) {
        return u => in_box(u, (ctx, r) => {
            for (const h of helpers) {
                if (!h.bars || !u.series[h.main].show) continue;
                ctx.strokeStyle = colour(h.colour);
                ctx.lineWidth = 1.5 * r;
                u.data[0].forEach((x, i) => {
                    const low = u.data[h.low][i], high = u.data[h.high][i];
                    if (low == null || high == null) return;
                    const px = u.valToPos(x, "x", true), a = u.valToPos(low, "y", true), b = u.valToPos(high, "y", true);
                    ctx.beginPath();
                    ctx.moveTo(px, a); ctx.lineTo(px, b);
                    ctx.moveTo(px - 4 * r, a); ctx.lineTo(px + 4 * r, a);
                    ctx.moveTo(px - 4 * r, b); ctx.lineTo(px + 4 * r, b);
                    ctx.stroke();
                });
            }
        });
    }

    // Symbols on the curves, so that they can be told apart without their colours: [path, filled].
    const shapes = [["M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0Z", true], ["M-3.5-3.5h7v7h-7Z", false], ["M0-4.6L4.3 3.4h-8.6Z", true],
                    ["M0-4.8L4.8 0L0 4.8L-4.8 0Z", false], ["M0 4.6L4.3-3.4h-8.6Z", true], ["M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0Z", false],
                    ["M-3.5-3.5h7v7h-7Z", true], ["M0-4.6L4.3 3.4h-8.6Z", false]];
    const shape_of = k => shapes[k % shapes.length];
    const is_line = c => c.mark !== "points";
    const has_symbols = chart => chart.curves.filter(c => c.weight !== "faint").length > 1;

    function stamp(ctx, r, k, stroke, x, y) {
        const [path, filled] = shape_of(k), shape = new Path2D(path);
        ctx.save();
        ctx.translate(x, y); ctx.scale(r, r);
        ctx.lineWidth = 1.5; ctx.strokeStyle = stroke; ctx.fillStyle = filled ? stroke : css("--paper");
        ctx.fill(shape); ctx.stroke(shape);
        ctx.restore();
    }

    // On a line every 80 pixels or so, those of different lines side by side; on points each.
    function draw_symbols(chart, columns) {
        return u => has_symbols(chart) && in_box(u, (ctx, r, box) => {
            const x = u.data[0], step = Math.max(80, box.width / r / 8), n = chart.curves.length;
            const shown = x.map((v, i) => i).filter(i => x[i] >= u.scales.x.min && x[i] <= u.scales.x.max);
            chart.curves.forEach((c, k) => {
                const y = u.data[columns[k]];
                if (c.weight === "faint" || !u.series[columns[k]].show) return;
                const valued = shown.filter(i => y[i] != null);
                let next = is_line(c) && valued.length > 12 ? ((k + 0.5) / n) * step : -1;
                for (const i of valued) {
                    const at = u.valToPos(x[i], "x", true);
                    if (next >= 0 && at < box.left + next * r) continue;
                    if (next >= 0) while (at >= box.left + next * r) next += step;
                    stamp(ctx, r, k, colour(c.colour), at, u.valToPos(y[i], "y", true));
                }
            });
        });
    }

    // In the legend a piece of the curve with its symbol.
    function draw_markers(chart, columns, u) {
        const rows = u.root.querySelectorAll(".u-series");
        chart.curves.forEach((c, k) => {
            const marker = rows[columns[k]]?.querySelector(".u-marker");
            if (!marker) return;
            const [path, filled] = shape_of(k), stroke = colour(c.colour), points = !is_line(c);
            const symbol = has_symbols(chart) && c.weight !== "faint" ? `<path d="${path}" stroke="${stroke}" stroke-width="1.5" fill="${filled ? stroke : css("--paper")}" ` +
                                                  'transform="translate(13 6)"/>'
                           : points ? `<circle cx="13" cy="6" r="3.5" fill="${stroke}"/>` : "";
            const line = points ? "" : `<path d="M0 6h26" stroke="${stroke}" stroke-width="${c.weight === "strong" ? 2.5 : 1.5}"` +
                                       (c.mark === "dashed" ? ' stroke-dasharray="7 4"' : "") + "/>";
            marker.classList.add("drawn");
            marker.innerHTML = `<svg width="26" height="12" aria-hidden="true">${line}${symbol}</svg>`;
        });
    }

    function options(chart, data, width) {
        const names = chart.xaxis.categories, columns = [];
        const ink = css("--axis"), grid = {stroke: css("--grid"), width: 1};
        const font = "12px system-ui, sans-serif";
        const series = [{label: names.length ? chart.xaxis.label || "case" : with_unit(chart.xaxis),
                         value: (u, v) => v == null ? "" : names.length ? names[Math.round(v)] ?? "" : number(v)}];
        const bands = [], helpers = [];
        for (const [k, c] of chart.curves.entries()) {
            const stroke = colour(c.colour);
            const points = c.mark === "points" || c.mark === "line_and_points";
            const main = series.length;
            columns.push(main);
            series.push({
                label: c.name + (chart.yaxis.unit && chart.yaxis.unit !== "–" ? " (" + chart.yaxis.unit + ")" : ""),
                stroke: c.mark === "points" ? (points ? stroke : undefined) : stroke,
                width: c.weight === "strong" ? 2.5 : c.weight === "faint" ? 0.8 : 1.5,
                alpha: c.weight === "faint" ? 0.7 : 1,
                dash: c.mark === "dashed" ? [7, 4] : undefined,
                paths: c.mark === "points" ? () => null : undefined,
                points: points && !(has_symbols(chart) && c.weight !== "faint") ? {show: true, size: 7, fill: stroke, stroke} : {show: false},
                spanGaps: chart.joined,
                pxAlign: 0,
                class: k !== chart.moving?.curve && c.y.every(v => v == null) ? "helper" : undefined, // nothing to draw, nothing to name
                value: (u, v) => v == null ? "" : number(v),
            });
            data.push(c.y);
            if (!c.low) continue;
            for (const side of ["high", "low"]) {
                data.push(c[side]);
                series.push({label: c.name + " " + side, class: "helper", paths: () => null, points: {show: false}, spanGaps: chart.joined});
            }
            const bars = c.mark === "points";
            helpers.push({main, high: main + 1, low: main + 2, bars, colour: c.colour});
            if (!bars) {
                const line = {paths: undefined, stroke: "transparent", width: 0};
                Object.assign(series[main + 1], line); Object.assign(series[main + 2], line);
                bands.push({series: [main + 1, main + 2], fill: stroke + "30"});
            }
        }
        const x_distr = chart.xaxis.scale === "log" ? 3 : chart.xaxis.scale === "asinh" ? 4 : 1;
        const y_distr = chart.yaxis.scale === "log" ? 3 : chart.yaxis.scale === "asinh" ? 4 : 1;
        const x_low = chart.xaxis.low, x_high = chart.xaxis.high;
        const ticks = (axis, key) => (u, i, low, high) => {
            const pixels = (key === "x" ? u.bbox.width : u.bbox.height) / uPlot.pxRatio;
            if (axis.scale === "log") return decades(low, high, low, pixels / (key === "x" ? 45 : 24));
            if (axis.scale === "asinh") return decades(low, high, axis.linear_below, pixels / (key === "x" ? 45 : 24));
            return even(low, high, Math.max(2, Math.min(10, pixels / (key === "x" ? 55 : 32))));
        };
        const labels = axis => (u, splits) => {
            const step = axis.scale === "linear" && splits.length > 1 ? splits[1] - splits[0] : 0;
            return splits.map(v => tick_text(v, step));
        };
        const short_names = names.map(s => s.length > 26 ? s.slice(0, 11) + "…" + s.slice(-14) : s); // the legend has the whole name
        const longest = short_names.reduce((n, s) => Math.max(n, s.length), 0);
        const tilted = names.length > 0 && longest * 7 * names.length > width - 70;
        const x_axis = {
            stroke: ink, font, labelFont: font, grid, ticks: grid, filter: (u, splits) => splits,
            label: names.length ? undefined : with_unit(chart.xaxis), labelSize: 20, size: 32,
            splits: names.length ? () => names.map((_, i) => i) : ticks(chart.xaxis, "x"),
            values: names.length ? () => short_names : labels(chart.xaxis),
        };
        let overhang = 0; // of tilted names left of the plot
        if (tilted) {
            const across = (width - 90) / names.length, cosine = Math.cos(40 * Math.PI / 180);
            overhang = Math.max(...short_names.map((s, i) => cosine * text_width(s) + 12 - (i + 0.5) * across));
            x_axis.rotate = 40;
            x_axis.size = Math.min(190, 18 + longest * 7 * 0.66);
        }
        const height = printing ? Math.min(chart.height, 215) : chart.height; // three on a page
        const along = Math.max(7, Math.min(12, Math.floor(12 * (height - 64) / text_width(with_unit(chart.yaxis))))); // px, whole: the label fits the axis
        const y_axis = {
            stroke: ink, font, labelFont: along + "px system-ui, sans-serif", grid, ticks: grid, filter: (u, splits) => splits,
            label: with_unit(chart.yaxis), labelSize: 22,
            splits: ticks(chart.yaxis, "y"), values: labels(chart.yaxis),
            size: (u, values) => Math.max(overhang - 22, 16 + 7.2 * Math.max(5, ...(values ?? []).map(s => s.length))),
        };
        if (text_width(with_unit(chart.yaxis)) * along > 12 * (height - 56)) crowded.add(chart.title + ": " + chart.yaxis.label);
        const x = data[0], span = x[x.length - 1] - x[0], scatter = chart.curves.every(c => c.mark === "points"); // points at the ends are whole
        const padded = (v, side) => !scatter || x_distr === 4 ? v : x_distr === 3 ? v * Math.pow(x[x.length - 1] / x[0], side * 0.03) : v + side * 0.03 * span;
        return {
            width, height: height + (tilted ? x_axis.size - 32 : 0),
            scales: {
                x: {time: false, distr: x_distr, asinh: chart.xaxis.linear_below,
                    range: (u, low, high) => names.length ? [Math.max(-0.5, low - 0.5), Math.min(names.length - 0.5, high + 0.5)]
                                           : low == null ? [x_low ?? 0, x_high ?? 1]
                                           : low === high ? [low - Math.abs(low || 1) / 2, high + Math.abs(high || 1) / 2]
                                           : low === data[0][0] && high === data[0][data[0].length - 1] ? [x_low ?? padded(low, -1), x_high ?? padded(high, 1)] : [low, high]},
                y: {distr: y_distr, asinh: chart.yaxis.linear_below, range: value_range(chart.yaxis, chart.horizontal.map(l => l.at))},
            },
            series, bands, axes: [x_axis, y_axis],
            cursor: {sync: chart.together ? {key: chart.together, scales: ["x", null]} : undefined,
                     points: {size: 7, show: (u, i) => u.series[i].class !== "helper" && document.createElement("div")}, drag: {x: true, y: false}},
            legend: {live: true},
            hooks: {drawAxes: [draw_lines(chart)], draw: [draw_bars(helpers), draw_symbols(chart, columns)],
                    setLegend: [u => empty_legend(u)]},
        };
    }

    // Without a cursor the legend names the curves and has no values.
    function empty_legend(u) {
        const idle = u.legend.idx == null;
        u.root.querySelector(".u-legend")?.classList.toggle("idle", idle);
        if (idle) u.root.querySelectorAll(".u-value").forEach(e => { e.firstChild.nodeValue = ""; });
    }

    const charts = []; // {figure, chart, plot}
    const pictures = []; // {figure, title, drawn, width, draw, is_empty}, of state_map.js and mesh_view.js

    function draw_picture(picture) {
        picture.drawn = picture.draw() || picture.drawn;
        picture.width = Math.floor(picture.figure.querySelector(".canvas").clientWidth);
    }

    function draw(entry) {
        const place = entry.figure.querySelector(".plot");
        const width = Math.floor(place.clientWidth);
        if (!width) return; // inside a folded part: drawn when it is opened
        if (entry.plot) entry.plot.destroy();
        place.textContent = "";
        const data = [entry.x];
        const opts = options(entry.chart, data, width);
        entry.columns = entry.chart.curves.map(c => data.indexOf(c.y));
        entry.plot = new uPlot(opts, data, place);
        entry.width = width;
        draw_markers(entry.chart, entry.columns, entry.plot);
        empty_legend(entry.plot);
    }

    // uPlot draws after the current task, so the marks are set after the next one.
    const mark_soon = () => setTimeout(mark, 0);
    const draw_all = () => { charts.forEach(draw); pictures.forEach(draw_picture); mark_soon(); };

    // ---- tools --------------------------------------------------------------------------------------------------------
    function save(name, blob) {
        const a = document.createElement("a");
        a.href = URL.createObjectURL(blob);
        a.download = name;
        a.click();
        setTimeout(() => URL.revokeObjectURL(a.href), 1000);
    }
    const file_name = title => title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "") || "chart";

    function csv(entry) {
        const quote = s => /[",\n\r]/.test(s) ? '"' + s.replace(/"/g, '""') + '"' : s;
        const {chart, x} = entry, names = chart.xaxis.categories;
        const head = [with_unit(chart.xaxis)], columns = [x.map(v => names.length ? quote(names[v] ?? "") : v)];
        for (const c of chart.curves) {
            const unit = chart.yaxis.unit && chart.yaxis.unit !== "–" ? " (" + chart.yaxis.unit + ")" : "";
            head.push(c.name + unit); columns.push(c.y);
            if (c.low) { head.push(c.name + ", low" + unit, c.name + ", high" + unit); columns.push(c.low, c.high); }
        }
        const rows = x.map((_, i) => columns.map(col => col[i] ?? "").join(","));
        return head.map(quote).join(",") + "\n" + rows.join("\n") + "\n";
    }

    function picture(entry) {
        const from = entry.plot.ctx.canvas, to = document.createElement("canvas");
        to.width = from.width; to.height = from.height;
        const ctx = to.getContext("2d");
        ctx.fillStyle = css("--paper");
        ctx.fillRect(0, 0, to.width, to.height);
        ctx.drawImage(from, 0, 0);
        to.toBlob(blob => save(file_name(entry.chart.title) + ".png", blob));
    }

    /// The chart and those that share cursor and zoom with it.
    const partners = entry => charts.filter(e => e.plot && (e === entry || (entry.chart.together && e.chart.together === entry.chart.together)));
    const show_all = entry => partners(entry).forEach(e => e.plot.setData(e.plot.data));

    /// Buttons beside the title of a figure. @returns  function that adds one
    function tool_bar(figure, name) {
        const bar = document.createElement("div");
        bar.className = "chart-tools";
        figure.querySelector("figcaption").append(bar);
        return (label, title, action) => {
            const b = document.createElement("button");
            b.type = "button"; b.textContent = label; b.title = title;
            b.setAttribute("aria-label", title + ": " + name);
            b.addEventListener("click", action);
            bar.append(b);
        };
    }

    function tools(entry) {
        const add = tool_bar(entry.figure, entry.chart.title);
        add("Whole range", "Undo the zoom (or double-click; drag in the chart to zoom)", () => show_all(entry));
        add("CSV", "Save the values", () => save(file_name(entry.chart.title) + ".csv", new Blob([csv(entry)], {type: "text/csv"})));
        add("PNG", "Save the picture", () => picture(entry));
    }

    // A slider that chooses the instant of the moving curve, here and in the charts that go together with this one.
    function slider(entry) {
        const moving = entry.chart.moving;
        if (!moving) return;
        const label = document.createElement("label"), input = document.createElement("input"), out = document.createElement("output");
        label.className = "slider";
        Object.assign(input, {type: "range", min: 0, max: moving.at.length - 1, step: 1, value: moving.start});
        const text = k => number(moving.at[k]) + " " + moving.unit;
        entry.move = k => {
            if (!(k in moving.y)) return;
            input.value = k;
            out.textContent = text(k);
            input.setAttribute("aria-valuetext", text(k));
            const curve = entry.chart.curves[moving.curve];
            curve.y = moving.y[k];
            if (!entry.plot) return;
            const data = entry.plot.data.slice();
            data[entry.columns[moving.curve]] = curve.y;
            entry.plot.setData(data, false);
            entry.plot.redraw();
        };
        input.setAttribute("aria-label", moving.label + " of " + entry.chart.curves[moving.curve].name + ": " + entry.chart.title);
        label.append(moving.label + " ", input, out);
        entry.figure.querySelector(".plot").before(label);
        input.addEventListener("input", () => charts.filter(e => e.move && (e === entry || (entry.chart.together && e.chart.together === entry.chart.together)))
                                                    .forEach(e => e.move(Number(input.value))));
        entry.move(moving.start);
    }

    // Keys: arrows move the cursor by a sample (with shift by a twentieth), plus and minus zoom around it, 0 shows all.
    function keys(entry) {
        entry.figure.querySelector(".plot").addEventListener("keydown", event => {
            const u = entry.plot;
            if (!u) return;
            const x = entry.x, low = u.scales.x.min, high = u.scales.x.max;
            let at = u.cursor.idx ?? x.findIndex(v => v >= (low + high) / 2);
            const stride = event.shiftKey ? Math.max(1, Math.round(x.length / 20)) : 1;
            if (event.key === "ArrowLeft") at = Math.max(0, at - stride);
            else if (event.key === "ArrowRight") at = Math.min(x.length - 1, at + stride);
            else if (event.key === "+" || event.key === "-") {
                const half = (high - low) / (event.key === "+" ? 4 : 1), middle = x[at];
                const a = Math.max(x[0], middle - half), b = Math.min(x[x.length - 1], middle + half);
                if (b > a) for (const e of partners(entry)) e.plot.setScale("x", {min: a, max: b});
            } else if (event.key === "0" || event.key === "Escape") show_all(entry);
            else return;
            event.preventDefault();
            u.setCursor({left: u.valToPos(x[at], "x"), top: u.over.clientHeight / 2}, true, true);
            const names = entry.chart.xaxis.categories;
            entry.figure.querySelector(".readout").textContent = with_unit(entry.chart.xaxis) + " " +
                (names.length ? names[x[at]] : number(x[at])) + ": " +
                entry.chart.curves.map(c => c.name + " " + number(c.y[at])).join(", ") + " " + entry.chart.yaxis.unit;
        });
    }

    // ---- what a test reads ----------------------------------------------------------------------------------------------
    // With #check in the address the canvases are searched for the colour of at least one curve.
    function pixels_of(canvas, left, top, width, height) {
        const copy = document.createElement("canvas");
        copy.width = width; copy.height = height;
        const ctx = copy.getContext("2d", {willReadFrequently: true});
        ctx.drawImage(canvas, -left, -top);
        return ctx.getImageData(0, 0, copy.width, copy.height).data;
    }

    function is_empty(entry) {
        if (!entry.plot) return false;
        const box = entry.plot.bbox;
        const wanted = entry.chart.curves.map(c => [1, 3, 5].map(i => parseInt(colour(c.colour).slice(i, i + 2), 16)));
        const pixels = pixels_of(entry.plot.ctx.canvas, box.left, box.top, box.width, box.height);
        for (let i = 0; i < pixels.length; i += 4)
            if (pixels[i + 3] > 200 && wanted.some(w => Math.abs(w[0] - pixels[i]) + Math.abs(w[1] - pixels[i + 1]) + Math.abs(w[2] - pixels[i + 2]) < 24))
                return false;
        return true;
    }

    let finished = false;
    function mark() {
        const d = document.getElementById("drawn");
        if (!d) return;
        d.dataset.charts = String(charts.length + pictures.length);
        d.dataset.drawn = String(charts.filter(e => e.plot).length + pictures.filter(p => p.drawn).length);
        d.dataset.errors = errors.join(" | ");
        if (location.hash === "#check") d.dataset.empty = charts.filter(is_empty).map(e => e.chart.title)
                .concat(pictures.filter(p => p.drawn && p.is_empty()).map(p => p.title)).join(" | ");
        d.dataset.crowded = [...crowded].join(" | ");
        d.dataset.wide = [...document.querySelectorAll(".drawing .scroll")].filter(e => e.querySelector(".signs") && e.scrollWidth > e.clientWidth + 1).length;
        d.dataset.state = errors.length ? "failed" : finished ? "drawn" : "drawing";
    }

    // ---- start ----------------------------------------------------------------------------------------------------------
    document.querySelectorAll("figure.chart").forEach(figure => {
        const chart = JSON.parse(figure.querySelector("script").textContent);
        const entry = {figure, chart, x: abscissae(chart.x), plot: null, width: 0};
        charts.push(entry);
        tools(entry);
        keys(entry);
        slider(entry);
    });
    document.querySelectorAll("figure.picture").forEach(figure => {
        const data = JSON.parse(figure.querySelector("script").textContent);
        const make = {state_map: damslip_state_map, mesh_view: damslip_mesh_view}[figure.dataset.kind];
        const picture = make(figure, data, {css, number, even, save, file_name, pixels: pixels_of, button: tool_bar(figure, data.title)});
        pictures.push(Object.assign(picture, {figure, title: data.title, drawn: false, width: 0}));
    });
    const check = location.hash === "#check";
    const unfold = open => document.querySelectorAll("details").forEach(d => { d.open = open; });
    if (check) unfold(true);
    finished = true;
    draw_all();

    document.getElementById("theme").addEventListener("click", () => {
        chosen = root.classList.contains("dark") ? "light" : "dark";
        set_theme();
        draw_all();
    });
    const all = document.getElementById("unfold");
    if (!document.querySelector("details")) all.hidden = true;
    all.addEventListener("click", () => {
        const open = all.textContent === "Open all";
        unfold(open);
        all.textContent = open ? "Fold all" : "Open all";
    });
    dark_wanted.addEventListener("change", () => { set_theme(); draw_all(); });
    document.addEventListener("toggle", event => {
        charts.filter(e => !e.plot && event.target.contains(e.figure)).forEach(draw);
        pictures.filter(p => !p.drawn && event.target.contains(p.figure)).forEach(draw_picture);
        mark_soon();
    }, true);
    let wait = 0;
    new ResizeObserver(() => {
        clearTimeout(wait);
        wait = setTimeout(() => {
            if (printing) return;
            charts.filter(e => e.width !== Math.floor(e.figure.querySelector(".plot").clientWidth)).forEach(draw);
            pictures.filter(p => p.width !== Math.floor(p.figure.querySelector(".canvas").clientWidth)).forEach(draw_picture);
        }, 150);
    }).observe(document.querySelector("main"));

    // Paper is white, 180 mm wide and has everything open: charts are drawn anew for it and back again.
    const paper_width = 680; // 180 mm [px]
    let folded = [];
    const smallest_letters = 8; // 6 pt [px]
    function fit_table(table) {
        table.style.fontSize = "";
        let wanted = parseFloat(getComputedStyle(table).fontSize);
        // Words do not shrink exactly with their letters, so once more where the first size is still too large.
        for (let k = 1; k <= 3 && table.offsetWidth > paper_width; ++k) {
            wanted = Math.max(smallest_letters, wanted * paper_width / table.offsetWidth * 0.99);
            table.style.fontSize = wanted + "px";
        }
        if (table.offsetWidth > paper_width) split_table(table);
    }

    // Too wide even so: the columns go below each other, each part with the first ones again. Taken away after printing.
    function split_table(table) {
        const first = table.rows[0], n = first.cells.length;
        if ([...table.rows].some(row => row.cells.length !== n)) return;
        const widths = [...first.cells].map(cell => cell.offsetWidth), again = widths[0] + widths[1] < paper_width / 3 ? 2 : 1;
        const repeated = widths.slice(0, again).reduce((a, b) => a + b, 0), parts = [];
        let room = 0;
        for (let k = again; k < n; ++k) {
            if (widths[k] > room) { parts.push([]); room = paper_width - repeated; }
            parts[parts.length - 1].push(k);
            room -= widths[k];
        }
        for (const part of parts) {
            const copy = table.cloneNode(true);
            copy.classList.add("piece");
            for (const row of copy.rows)
                for (let k = n - 1; k >= again; --k) if (!part.includes(k)) row.deleteCell(k);
            table.parentNode.append(copy);
        }
        table.classList.add("in-pieces");
    }
    function undo_fit(table) {
        table.style.fontSize = "";
        table.classList.remove("in-pieces");
    }
    function paper(on) {
        if (printing === on) return;
        printing = on;
        if (on) folded = [...document.querySelectorAll("details:not([open])")];
        folded.forEach(d => { d.open = on; });
        root.classList.toggle("paper", on);
        set_theme();
        document.querySelectorAll(".plot, .canvas").forEach(p => { p.style.width = on ? paper_width - 8 + "px" : ""; });
        document.querySelectorAll(".scroll > .piece").forEach(t => t.remove());
        document.querySelectorAll(".scroll > table").forEach(on ? fit_table : undo_fit);
        draw_all();
    }
    window.addEventListener("beforeprint", () => paper(true));
    window.addEventListener("afterprint", () => paper(false));
    print_wanted.addEventListener("change", e => paper(e.matches));
})();
