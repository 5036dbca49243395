// SPDX-License-Identifier: Apache-2.0
// The charts of a report, and what a click or a key does. Everything said here stands in the page's tables, too.
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const root = document.documentElement;
  root.classList.add("js");
  const color = (name) => getComputedStyle(root).getPropertyValue("--" + name).trim();
  const value = (metric) => (metric === undefined ? undefined : metric.value);
  const activities = ["busy", "starved", "blocked", "memory", "synchroniser", "blanking"];
  const titles = { busy: "busy", starved: "upstream empty", blocked: "downstream full", memory: "memory",
    synchroniser: "synchroniser", blanking: "blanking" };
  const palette = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#b8a900", "#7a5cc4", "#8a9099", "#4a9a2f",
    "#a0522d"];
  const charts = [];

  const number = (x, digits) => x.toLocaleString("en", { maximumFractionDigits: digits, minimumFractionDigits: digits });

  function chart(id, make) {
    const canvas = document.getElementById(id);
    if (!canvas) return;
    const draw = () => {
      const old = Chart.getChart(canvas);
      if (old) old.destroy();
      const settings = make();
      Chart.defaults.color = color("soft");
      Chart.defaults.borderColor = color("line");
      settings.options = Object.assign({ responsive: true, maintainAspectRatio: false, animation: false,
        interaction: { mode: "index", intersect: false } }, settings.options);
      new Chart(canvas, settings);
    };
    charts.push(draw);
    draw();
  }

  const axis = (text, more) => Object.assign({ title: { display: true, text } }, more);

  // Time per stage, as stacked shares.
  if (data.stages) {
    const names = Object.keys(data.stages);
    chart("chart-stages", () => ({
      type: "bar",
      data: { labels: names, datasets: activities.map((activity) => ({
        label: titles[activity], backgroundColor: color(activity),
        data: names.map((name) => value(data.stages[name][activity + "_share"])) })) },
      options: { indexAxis: "y", scales: { x: axis("share of the time, %", { stacked: true, max: 100 }), y: { stacked: true } } },
    }));
  }

  // How full a FIFO was.
  const streams = document.getElementById("stream");
  if (streams && data.streams) {
    const fifo = () => {
      const stream = data.streams[streams.value];
      const width = value(stream.occupancy_bin);
      const cycles = value(stream.occupancy);
      const all = cycles.reduce((sum, x) => sum + x, 0) || 1;
      return {
        type: "bar",
        data: { labels: cycles.map((_, i) => (width === 1 ? String(i) : i * width + " to " + ((i + 1) * width - 1))),
          datasets: [{ label: "share of the time, %", backgroundColor: color("busy"),
            data: cycles.map((x) => 100 * x / all) }] },
        options: { plugins: { legend: { display: false } },
          scales: { x: axis("tokens held in " + streams.value + ", of " + value(stream.depth)), y: axis("share of the time, %", { beginAtZero: true }) } },
      };
    };
    chart("chart-fifo", fifo);
    streams.addEventListener("change", () => charts.forEach((draw) => draw()));
  }

  // The memory over a frame.
  const frame = data.profile && data.profile.frame;
  if (frame) {
    const ports = Object.keys(frame.bandwidth);
    chart("chart-memory", () => ({
      type: "line",
      data: { labels: frame.bandwidth[ports[0]].map((_, i) => number(i * frame.bin / 1e9, 2)),
        datasets: ports.map((port, i) => ({ label: port, data: frame.bandwidth[port], fill: i === 0 ? "origin" : "-1", stepped: true, pointRadius: 0,
          borderWidth: 1, borderColor: palette[i % palette.length], backgroundColor: palette[i % palette.length] + "99" })) },
      options: { scales: { x: axis("ms of a frame's period", { ticks: { maxTicksLimit: 12 } }),
        y: axis("MB/s, ports on top of each other", { stacked: true, beginAtZero: true }) } },
    }));
    const map = frame.rows.map;
    if (map) chart("chart-map", () => ({
      data: { labels: map.bytes.map((_, i) => i), datasets: [
        { type: "bar", label: "bytes", data: map.bytes, backgroundColor: color("busy"), yAxisID: "y", barPercentage: 1,
          categoryPercentage: 1, order: 1 },
        { type: "line", label: "mean latency of its bursts, ns", data: map.latency_mean.map((x) => x / 1e3), pointRadius: 0,
          borderWidth: 1, borderColor: color("starved"), backgroundColor: color("starved"), yAxisID: "latency", order: 0 }] },
      options: { scales: { x: axis("row of the rectification map", { ticks: { maxTicksLimit: 16 } }),
        y: axis("bytes of the row", { beginAtZero: true }),
        latency: axis("ns", { position: "right", beginAtZero: true, grid: { drawOnChartArea: false } }) } },
    }));
  }

  // Latencies: of frames, and of bursts at a memory port.
  const spans = document.getElementById("span");
  if (spans && data.profile && data.profile.latency) {
    chart("chart-latency", () => {
      const counts = data.profile.latency[spans.value];
      const frames = spans.selectedOptions[0].dataset.unit === "ms";
      const scale = frames ? 1e9 : 1e3;
      return {
        type: "bar",
        data: { labels: counts.at_most.map((x) => number(x / scale, frames ? 3 : 1)),
          datasets: [{ label: frames ? "frames" : "bursts", data: counts.count, backgroundColor: color("busy") }] },
        options: { plugins: { legend: { display: false } },
          scales: { x: axis(spans.value.replace(/_/g, " ") + ": at most, " + (frames ? "ms" : "ns"), { ticks: { maxTicksLimit: 16 } }),
            y: axis(frames ? "frames" : "bursts", { beginAtZero: true }) } },
      };
    });
    spans.addEventListener("change", () => charts.forEach((draw) => draw()));
  }

  if (data.energy) {
    const parts = Object.keys(data.energy).filter((name) => name.startsWith("power_") && name !== "power_total");
    chart("chart-energy", () => ({
      type: "bar",
      data: { labels: parts.map((name) => name.slice(6).replace(/_/g, " ")),
        datasets: [{ label: "W", data: parts.map((name) => value(data.energy[name])), backgroundColor: color("busy") }] },
      options: { indexAxis: "y", plugins: { legend: { display: false } }, scales: { x: axis("W, estimated", { beginAtZero: true }) } },
    }));
  }

  if (data.relaxations) {
    const gains = data.relaxations.relaxations.filter((entry) => entry.gain);
    chart("chart-limits", () => ({
      type: "bar",
      data: { labels: gains.map((entry) => entry.name.replace(/_/g, " ")),
        datasets: [{ label: "gain, %", data: gains.map((entry) => value(entry.gain)), backgroundColor: color("limit") }] },
      options: { indexAxis: "y", plugins: { legend: { display: false } },
        scales: { x: axis("gain of the frame rate with this limit alone taken away, %") } },
    }));
  }

  if (data.comparison) {
    chart("chart-comparison", () => ({
      type: "bar",
      data: { labels: data.comparison.names, datasets: ["a", "b"].map((run) => ({ label: run.toUpperCase(),
        data: data.comparison[run], backgroundColor: color(run === "a" ? "busy" : "starved") })) },
      options: { indexAxis: "y", scales: { x: axis("of the time, %", { beginAtZero: true, max: 100 }) } },
    }));
  }

  // A stage's numbers beside the diagram.
  const details = document.getElementById("details");
  const nodes = [...document.querySelectorAll("svg.diagram a[data-stage]")];
  function choose(node) {
    const name = node.dataset.stage;
    const stage = data.stages[name];
    if (!stage) return;
    nodes.forEach((other) => other.classList.toggle("chosen", other === node));
    document.querySelectorAll("tr.chosen").forEach((row) => row.classList.remove("chosen"));
    const row = document.getElementById("stage-" + name);
    if (row) row.classList.add("chosen");
    const list = document.createElement("dl");
    const add = (term, description, text) => {
      const dt = document.createElement("dt");
      const dd = document.createElement("dd");
      dt.textContent = term.replace(/_/g, " ");
      dt.title = description || "";
      dd.textContent = text;
      list.append(dt, dd);
    };
    for (const [key, metric] of Object.entries(stage)) {
      if (activities.includes(key)) continue;  // the shares say it
      add(key, metric.description, data.texts.stages[name][key]);
    }
    for (const [stream, numbers] of Object.entries(data.streams)) {
      const ends = [value(numbers.writer), value(numbers.reader)].map((path) => path.split(".").pop());
      if (!ends.includes(name)) continue;
      add((ends[0] === name ? "to " : "from ") + stream, "Tokens held on average, of the FIFO's depth.",
        data.texts.held[stream]);
    }
    const heading = document.createElement("h3");
    heading.textContent = name;
    details.replaceChildren(heading, list);
  }
  nodes.forEach((node, i) => {
    node.addEventListener("click", (event) => { event.preventDefault(); choose(node); });
    node.addEventListener("keydown", (event) => {
      if (event.key === " ") { event.preventDefault(); choose(node); }
      const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
      if (step) { event.preventDefault(); nodes[(i + step + nodes.length) % nodes.length].focus(); }
    });
  });

  document.querySelectorAll("button.theme").forEach((button) => button.addEventListener("click", () => {
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    charts.forEach((draw) => draw());
  }));
  document.querySelectorAll("button.copy").forEach((button) => button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(document.getElementById(button.dataset.of).textContent);
    button.textContent = "copied";
  }));
  addEventListener("beforeprint", () => charts.forEach((draw) => draw()));
  document.body.dataset.charts = String(charts.length);
})();
