"use strict";
// Draws a figure of the page with Plotly, from the JSON beside it, when a reader asks for it. The
// static drawing stays in the page and is what prints.
(() => {
  const source = document.getElementById("plotting-library");
  if (!source) return;

  // As app/figures/series_look.hpp has them.
  const looks = [
    ["#0072b2", "solid", "circle"],
    ["#d55e00", "9px,3px", "square"],
    ["#009e73", "9px,3px,2px,3px", "diamond"],
    ["#b0508a", "2px,2px", "triangle-up"],
    ["#333333", "14px,3px", "triangle-down"],
    ["#e08e00", "9px,2px,2px,2px,2px,2px", "cross"],
    ["#3a9bdc", "5px,2px", "x"],
    ["#7a7a7a", "14px,3px,2px,3px", "star"],
  ];

  let library = null;
  const plotly = () => {
    if (!library) {
      const script = document.createElement("script");
      script.textContent = source.textContent;
      document.head.append(script);
      library = window.Plotly;
    }
    return library;
  };

  const plain = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
  const named = (axis) => (axis.unit ? `${axis.label} (${axis.unit})` : axis.label);
  // A number is shown as the JSON has it: no rounding of its own.
  const shown = (axis, value) => {
    if (value === null || value === undefined) return "none";
    const category = axis.categories && axis.categories[value];
    if (category !== undefined) return category;
    return axis.unit ? `${value} ${axis.unit}` : `${value}`;
  };
  const quantity = (axis, value) => `${axis.label ? `${axis.label}: ` : ""}${shown(axis, value)}`;

  // What is said of point i of a series, a line each.
  const words = (figure, panel, series, i) => {
    const lines = [];
    if (series.name) lines.push(series.name);
    if (series.labels && series.labels[i]) lines.push(series.labels[i]);
    lines.push(quantity(figure.x, series.x[i]), quantity(panel.y, series.y[i]));
    for (const [axis, low, high] of [
      [figure.x, series.x_lower, series.x_upper],
      [panel.y, series.y_lower, series.y_upper],
    ]) {
      if (low && high) lines.push(`${shown(axis, low[i])} to ${shown(axis, high[i])}`);
    }
    return lines;
  };

  const spread = (values, low, high) => ({
    type: "data",
    symmetric: false,
    array: values.map((value, i) => (high[i] === null || value === null ? 0 : high[i] - value)),
    arrayminus: values.map((value, i) => (low[i] === null || value === null ? 0 : value - low[i])),
    thickness: 1.2,
    width: 4,
  });

  const band = (series, colour, axes) => {
    const at = series.x.map((_, i) => i).filter((i) => series.x[i] !== null && series.y_lower[i] !== null && series.y_upper[i] !== null);
    return {
      ...axes,
      x: [...at.map((i) => series.x[i]), ...at.reverse().map((i) => series.x[i])],
      y: [...at.map((i) => series.y_lower[i]).reverse(), ...at.map((i) => series.y_upper[i])],
      mode: "lines",
      line: { width: 0 },
      fill: "toself",
      fillcolor: `${colour}2e`,
      hoverinfo: "skip",
      showlegend: false,
    };
  };

  const bars = (series, trace, colour, sideways) => {
    const [low, high] = sideways ? [series.x_lower, series.x_upper] : [series.y_lower, series.y_upper];
    const along = sideways ? "x" : "y";
    const bar = { ...trace, type: "bar", orientation: sideways ? "h" : "v", marker: { color: `${colour}b0`, line: { color: colour, width: 1 } } };
    if (low && high) {
      bar.base = low;
      bar[along] = high.map((value, i) => (value === null || low[i] === null ? null : value - low[i]));
    }
    return bar;
  };

  // The traces of one series; the last of them is the one whose points are read.
  const traces = (figure, panel, series, look, axes, inLegend) => {
    const round = Math.floor(look / looks.length);
    const colour = looks[look % looks.length][0];
    const dash = looks[(look + 3 * round) % looks.length][1];
    const symbol = looks[(look + 5 * round) % looks.length][2];
    const trace = {
      ...axes,
      x: series.x,
      y: series.y,
      name: plain(series.name),
      showlegend: inLegend,
      legendgroup: series.name,
      hovertext: series.x.map((_, i) => words(figure, panel, series, i).map(plain).join("<br>")),
      customdata: series.x.map((_, i) => words(figure, panel, series, i).join("; ")),
      hovertemplate: "%{hovertext}<extra></extra>",
    };
    if (series.style === "bars") return [bars(series, trace, colour, Boolean(panel.y.categories))];
    const points = series.style === "points";
    trace.type = "scatter";
    trace.mode = points ? "markers" : series.style === "line and points" ? "lines+markers" : "lines";
    trace.line = { color: colour, width: 1.7, dash: series.style === "dashed" ? "5px,3px" : dash, simplify: false };
    if (series.style === "steps") trace.line.shape = "hv";
    trace.marker = { color: colour, symbol, size: points ? 7 : 5.5 };
    if (series.x_lower && series.x_upper) trace.error_x = { ...spread(series.x, series.x_lower, series.x_upper), color: colour };
    if (!series.y_lower || !series.y_upper) return [trace];
    if (trace.mode === "lines") return [band(series, colour, axes), trace];
    trace.error_y = { ...spread(series.y, series.y_lower, series.y_upper), color: colour };
    return [trace];
  };

  // On a logarithmic axis more than so many ticks would bring out every digit, one over the other.
  const axisLayout = (axis, logTicks) => {
    const layout = {
      title: { text: plain(named(axis)), font: { size: 12 }, standoff: 8 },
      type: axis.scale === "logarithmic" ? "log" : "linear",
      automargin: true,
      showline: true,
      linecolor: "#333",
      ticks: "outside",
      gridcolor: "#e2e2e2",
      zerolinecolor: "#9a9a9a",
      exponentformat: "power",
      minor: { showgrid: axis.scale === "logarithmic", gridcolor: "#f2f2f2" },
    };
    if (axis.scale === "logarithmic") layout.nticks = logTicks;
    if (axis.categories) {
      layout.tickvals = axis.categories.map((_, i) => i);
      layout.ticktext = axis.categories.map(plain);
      layout.zeroline = false;
      layout.range = [-0.5, axis.categories.length - 0.5];
    } else if (axis.lowest !== undefined || axis.highest !== undefined) {
      const at = (value) => (value === undefined ? null : axis.scale === "logarithmic" ? Math.log10(value) : value);
      layout.range = [at(axis.lowest), at(axis.highest)];
      layout.autorange = layout.range[0] === null ? "min" : layout.range[1] === null ? "max" : false;
    }
    return layout;
  };

  const shapes = (panel, yaxis) => {
    const dark = { color: "#444", width: 1, dash: "dot" };
    const label = (text, position) => ({ text: plain(text), textposition: position, font: { size: 11, color: "#333" }, padding: 2 });
    const lines = (panel.lines || []).map((line) =>
      line.direction === "horizontal"
        ? { type: "line", xref: "x domain", yref: yaxis, x0: 0, x1: 1, y0: line.at, y1: line.at, line: dark, label: { ...label(line.label, "end"), yanchor: "bottom" } }
        : { type: "line", xref: "x", yref: `${yaxis} domain`, x0: line.at, x1: line.at, y0: 0, y1: 1, line: dark, label: { ...label(line.label, "end"), textangle: -90, yanchor: "top" } });
    const circles = (panel.circles || []).map((circle) => ({
      type: "circle", xref: "x", yref: yaxis,
      x0: circle.x - circle.radius, x1: circle.x + circle.radius, y0: circle.y - circle.radius, y1: circle.y + circle.radius,
      line: dark, label: label(circle.label, "middle center"),
    }));
    return [...lines, ...circles];
  };

  const said = (figure, panel, mark) => [mark.label, quantity(figure.x, mark.x), quantity(panel.y, mark.y)];
  const marks = (figure, panel, axes) => ({
    ...axes,
    type: "scatter",
    mode: "markers+text",
    x: panel.marks.map((mark) => mark.x),
    y: panel.marks.map((mark) => mark.y),
    text: panel.marks.map((mark) => plain(mark.label)),
    textposition: "top center",
    textfont: { size: 11 },
    marker: { color: "#fff", size: 8, line: { color: "#222", width: 1.4 } },
    hovertext: panel.marks.map((mark) => said(figure, panel, mark).map(plain).join("<br>")),
    customdata: panel.marks.map((mark) => said(figure, panel, mark).join("; ")),
    hovertemplate: "%{hovertext}<extra></extra>",
    showlegend: false,
    cliponaxis: false,
  });

  // Plotly's data and layout of a figure, and the series whose points can be read, by trace.
  const translated = (figure, height) => {
    const names = [...new Set(figure.panels.flatMap((panel) => panel.series.map((series) => series.name)))];
    const listed = new Set();
    const data = [];
    const readable = [];
    const layout = {
      height,
      margin: { l: 56, r: 14, t: 8, b: 44 },
      font: { family: "'DejaVu Sans', Verdana, Arial, sans-serif", size: 11, color: "#222" },
      hovermode: "closest",
      hoverlabel: { align: "left", bgcolor: "#fff", bordercolor: "#555", font: { size: 12, color: "#1d232b" } },
      dragmode: "zoom",
      showlegend: names.filter(Boolean).length > 0,
      legend: { orientation: "h", x: 0, y: 1.0, yanchor: "bottom" },
      shapes: [],
      barmode: "group",
      xaxis: axisLayout(figure.x, 6),
    };
    const count = figure.panels.length;
    const gap = count > 1 ? 0.07 : 0;
    const panelHeight = (1 - gap * (count - 1)) / count;
    figure.panels.forEach((panel, p) => {
      const id = p === 0 ? "" : `${p + 1}`;
      const axes = { xaxis: "x", yaxis: `y${id}` };
      const top = 1 - p * (panelHeight + gap);
      layout[`yaxis${id}`] = { ...axisLayout(panel.y, 3), anchor: "x", domain: [Math.max(0, top - panelHeight), top] };
      if (panel.y.categories) layout[`yaxis${id}`].range.reverse();
      if (figure.equal_scales) Object.assign(layout[`yaxis${id}`], { scaleanchor: "x", scaleratio: 1 });
      layout.shapes.push(...shapes(panel, `y${id}`));
      if (panel.series.some((series) => series.style === "bars" && (series.x_lower || series.y_lower))) layout.barmode = "overlay";
      for (const series of panel.series) {
        const made = traces(figure, panel, series, names.indexOf(series.name), axes, Boolean(series.name) && !listed.has(series.name));
        listed.add(series.name);
        data.push(...made);
        readable.push({ trace: data.length - 1, subplot: `xy${id}`, panel, series });
      }
      if (panel.marks) data.push(marks(figure, panel, axes));
    });
    layout.xaxis.anchor = count > 1 ? `y${count}` : "y";
    return { data, layout, readable };
  };

  // Names of marks, lines and circles may stand over others: of those only the first is shown, until
  // zooming parts them. Ticks, titles and legends go first.
  const partLabels = (live) => {
    const boxes = [...live.querySelectorAll("text")]
      .filter((text) => text.textContent && !text.closest(".textpoint, .shape-label, .hoverlayer, .modebar"))
      .map((text) => text.getBoundingClientRect());
    for (const label of live.querySelectorAll(".textpoint text, .shape-label text")) {
      const box = label.getBoundingClientRect();
      const free = boxes.every((other) => box.right <= other.left || box.left >= other.right || box.bottom <= other.top || box.top >= other.bottom);
      label.style.visibility = free ? "visible" : "hidden";
      if (free) boxes.push(box);
    }
  };

  class LiveFigure {
    constructor(element) {
      this.element = element;
      this.button = element.querySelector(".explore");
      this.reading = element.querySelector(".reading");
      this.live = element.querySelector(".live");
      this.made = null;
      this.series = 0;
      this.point = -1;
      const still = element.querySelector(".static");
      this.button.hidden = false;
      this.button.addEventListener("click", () => (this.exploring() ? this.leave() : this.explore(true)));
      element.addEventListener("keydown", (event) => this.key(event));
      still.addEventListener("pointerenter", (event) => {
        if (event.pointerType === "mouse") this.waiting = setTimeout(() => this.explore(false), 250);
      });
      still.addEventListener("pointerleave", () => clearTimeout(this.waiting));
      this.still = still;
    }

    exploring() {
      return this.element.classList.contains("exploring");
    }

    explore(byKey) {
      if (!this.exploring()) {
        const height = this.still.getBoundingClientRect().height;
        this.element.classList.add("exploring");
        this.button.textContent = "Static";
        if (this.made) {
          plotly().Plots.resize(this.live);
        } else {
          this.figure = JSON.parse(this.element.querySelector("script.data").textContent);
          this.made = translated(this.figure, Math.max(height, 220));
          plotly().newPlot(this.live, this.made.data, this.made.layout, {
            responsive: true,
            displaylogo: false,
            modeBarButtonsToRemove: ["select2d", "lasso2d"],
            plotlyServerURL: "",
          });
          this.home = this.ranges();
          partLabels(this.live);
          this.live.on("plotly_afterplot", () => partLabels(this.live));
          this.live.on("plotly_hover", (event) => this.say(event.points[0]));
        }
      }
      if (byKey) {
        this.element.focus();
        this.reading.textContent = "Arrow keys: points and series; + and - zoom; 0: all; Escape: back to the static figure.";
      }
    }

    leave() {
      this.element.classList.remove("exploring");
      this.button.textContent = "Explore";
      this.reading.textContent = "";
      this.point = -1;
    }

    say(point) {
      const text = point.data.customdata && point.data.customdata[point.pointNumber];
      if (text) this.reading.textContent = text;
    }

    ranges() {
      const full = this.live._fullLayout;
      return Object.fromEntries(Object.keys(full).filter((name) => /^[xy]axis\d*$/.test(name)).map((name) => [`${name}.range`, [...full[name].range]]));
    }

    // The next point with numbers, from `at` on in steps of `step`.
    seek(at, step) {
      const { series } = this.made.readable[this.series];
      for (let i = at; i >= 0 && i < series.x.length; i += step) {
        if (series.x[i] !== null && series.y[i] !== null) return i;
      }
      return -1;
    }

    show(point) {
      if (point < 0) return;
      this.point = point;
      const { trace, subplot } = this.made.readable[this.series];
      plotly().Fx.hover(this.live, [{ curveNumber: trace, pointNumber: point }], subplot);
      this.reading.textContent = this.live.data[trace].customdata[point];
    }

    // To the point of another series that is nearest in x.
    change(step) {
      const all = this.made.readable;
      const from = all[this.series].series.x[this.point];
      this.series = (this.series + step + all.length) % all.length;
      const { series } = all[this.series];
      let best = -1;
      series.x.forEach((x, i) => {
        if (x === null || series.y[i] === null) return;
        if (best < 0 || Math.abs(x - from) < Math.abs(series.x[best] - from)) best = i;
      });
      this.show(best);
    }

    zoom(factor) {
      const full = this.live._fullLayout;
      const at = this.made.readable[this.series];
      const change = {};
      for (const [name, axis, value] of [
        ["xaxis", full.xaxis, at.series.x[this.point]],
        [`yaxis${at.subplot.slice(2)}`, full[`yaxis${at.subplot.slice(2)}`], at.series.y[this.point]],
      ]) {
        const known = value !== null && value !== undefined;
        const centre = known ? (axis.type === "log" ? Math.log10(value) : value) : (axis.range[0] + axis.range[1]) / 2;
        change[`${name}.range`] = axis.range.map((end) => centre + (end - centre) * factor);
      }
      plotly().relayout(this.live, change);
    }

    key(event) {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.key === "Enter" && event.target === this.element) return this.explore(true);
      if (!this.exploring() || event.target === this.button) return;
      const actions = {
        Escape: () => this.leave(),
        ArrowRight: () => this.show(this.seek(this.point + 1, 1)),
        ArrowLeft: () => this.show(this.seek(this.point < 0 ? this.made.readable[this.series].series.x.length - 1 : this.point - 1, -1)),
        ArrowDown: () => this.change(1),
        ArrowUp: () => this.change(-1),
        "+": () => this.zoom(1 / 1.5),
        "=": () => this.zoom(1 / 1.5),
        "-": () => this.zoom(1.5),
        0: () => plotly().relayout(this.live, structuredClone(this.home)),
      };
      if (!actions[event.key]) return;
      event.preventDefault();
      actions[event.key]();
    }
  }

  for (const element of document.querySelectorAll("figure.plot")) new LiveFigure(element);
})();
