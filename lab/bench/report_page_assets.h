// Style sheet and script of the benchmark report; both are embedded in the page.
#pragma once

namespace etendue::bench {

constexpr const char* kReportStyle = R"html(<style>
.facts { display: grid; grid-template-columns: max-content 1fr; gap: 2px 16px; margin: 16px 0 }
.facts dt { color: var(--soft) } .facts dd { margin: 0 }
.warning { background: var(--warn); border-left: 4px solid #e69f00; padding: 8px 12px }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 480px), 1fr)); gap: 16px }
.chart { position: relative; margin: 0 }
.chart svg { display: block; width: 100%; height: auto } .chart svg > rect { fill: none }
.tip { position: absolute; transform: translate(-50%, calc(-100% - 12px)); background: var(--card); padding: 4px 10px;
  border: 1px solid var(--line); border-radius: 4px; font-size: 13px; white-space: pre; pointer-events: none }
.figures th + th, .figures td + td { text-align: right; white-space: nowrap }
.figures td:first-child { position: sticky; left: 0; background: var(--page); overflow-wrap: anywhere; min-width: 12ch }
.swatch { display: inline-block; width: 18px; height: 3px; margin-right: 8px; vertical-align: middle }
.wipe { position: relative; background: var(--card); overflow: hidden; touch-action: none; cursor: ew-resize;
  width: min(100%, calc(85vh * var(--w) / var(--h))); aspect-ratio: var(--w) / var(--h) }
.wipe img { position: absolute; width: 100%; height: 100%; user-select: none }
.wipe div { position: absolute; top: 0; bottom: 0; width: 2px; margin-left: -1px; background: #fff;
  box-shadow: 0 0 0 1px #0008 }
.choice { display: flex; flex-wrap: wrap; justify-content: space-between; gap: 8px 16px; margin: 8px 0 }
.choice label { display: flex; gap: 8px; align-items: center; min-width: 0 }
select { font: inherit; max-width: min(100%, 40ch) }
input[type=range] { display: block; width: min(100%, calc(85vh * var(--w) / var(--h))); margin: 8px 0 24px;
  accent-color: var(--accent) }
.gallery { display: grid; grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); gap: 12px; margin: 8px 0 16px }
.gallery button { display: flex; flex-direction: column; font: inherit; font-size: 13px; color: inherit;
  text-align: left; background: var(--card); padding: 0;
  border: 1px solid var(--line); border-radius: 4px; overflow: hidden; cursor: pointer; overflow-wrap: anywhere }
.gallery button[aria-pressed=true] { border-color: var(--accent); box-shadow: 0 0 0 1px var(--accent) }
.gallery img { width: 100% } .gallery span { display: block; padding: 4px 8px }
.scale { display: inline-block; width: 120px; height: 10px; vertical-align: middle; margin: 0 6px }
pre { background: var(--card); padding: 12px; overflow-x: auto; white-space: pre-wrap; overflow-wrap: anywhere;
  font-size: 13px }
</style>
)html";

// The fragment of the address may select images and divider position: #left=0&right=2&wipe=0.3.
constexpr const char* kReportScript = R"html(<script>
const $ = id => document.getElementById(id);

for (const figure of document.querySelectorAll(".chart")) {
  const svg = figure.querySelector("svg"), tip = figure.querySelector(".tip"), view = svg.viewBox.baseVal;
  const dots = [...svg.querySelectorAll("g")].map(g => {
    const title = g.querySelector("title"), circle = g.querySelector("circle"), text = title.textContent;
    title.remove();
    return { x: +circle.getAttribute("cx"), y: +circle.getAttribute("cy"), text, name: text.split("\n")[0] };
  });
  if (!dots.length) continue;
  const ring = svg.appendChild(document.createElementNS(svg.namespaceURI, "circle"));
  for (const [name, value] of Object.entries({ r: 6, fill: "none", stroke: "#222222", "stroke-width": 2, opacity: 0 }))
    ring.setAttribute(name, value);
  let at = -1;
  const hide = () => { ring.setAttribute("opacity", 0); tip.hidden = true; };
  const mark = i => {
    at = i;
    const { x, y, text } = dots[i];
    ring.setAttribute("cx", x);
    ring.setAttribute("cy", y);
    ring.setAttribute("opacity", 1);
    tip.textContent = text;
    tip.hidden = false;
    const half = 50 * tip.offsetWidth / svg.clientWidth;
    tip.style.left = Math.min(Math.max(100 * x / view.width, half), 100 - half) + "%";
    tip.style.top = 100 * y / view.height + "%";
  };
  svg.onpointermove = svg.onpointerdown = e => {
    const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse());
    const distances = dots.map(d => Math.hypot(d.x - p.x, d.y - p.y));
    const nearest = distances.indexOf(Math.min(...distances));
    distances[nearest] < 40 ? mark(nearest) : hide();
  };
  svg.onpointerleave = figure.onblur = hide;
  const names = [...new Set(dots.map(d => d.name))];
  figure.onkeydown = e => {
    const along = { ArrowLeft: -1, ArrowRight: 1 }[e.key], across = { ArrowUp: -1, ArrowDown: 1 }[e.key];
    if (e.key === "Escape") hide();
    if (!along && !across) return;
    e.preventDefault();
    if (at < 0) return mark(0);
    if (along) return dots[at + along]?.name === dots[at].name && mark(at + along);
    const next = names[(names.indexOf(dots[at].name) + across + names.length) % names.length];
    const distances = dots.map(d => d.name === next ? Math.abs(d.x - dots[at].x) : Infinity);
    mark(distances.indexOf(Math.min(...distances)));
  };
}

const buttons = [...document.querySelectorAll(".gallery button")];
const update_divider = () => {
  const percent = $("at").value / 10;
  $("over").style.clipPath = "inset(0 0 0 " + percent + "%)";
  $("edge").style.left = percent + "%";
};
const show = (side, image, index) => {
  const source = buttons[index].querySelector("img");
  $(side).selectedIndex = index;
  $(image).src = source.src;
  $(image).alt = side + ": " + source.alt;
  const chosen = [$("left").selectedIndex, $("right").selectedIndex];
  buttons.forEach((p, i) => p.setAttribute("aria-pressed", chosen.includes(i)));
};
const fragment = new URLSearchParams(location.hash.slice(1));
for (const [side, image, first] of [["left", "under", 0], ["right", "over", 1]]) {
  for (const p of buttons) $(side).add(new Option(p.querySelector("img").alt));
  const selected = fragment.has(side) ? +fragment.get(side) || 0 : first;
  show(side, image, Math.min(Math.max(selected, 0), buttons.length - 1));
  $(side).oninput = () => show(side, image, $(side).selectedIndex);
}
buttons.forEach((p, i) => {
  p.onclick = () => { show("right", "over", i); $("wipe").scrollIntoView({ block: "nearest" }); };
});
const drag = e => {
  if (e.type === "pointermove" && !e.buttons) return;
  if (e.type === "pointerdown") $("wipe").setPointerCapture(e.pointerId);
  const box = $("wipe").getBoundingClientRect();
  $("at").value = 1000 * (e.clientX - box.left) / box.width;
  update_divider();
};
$("wipe").onpointerdown = $("wipe").onpointermove = drag;
$("wipe").ondragstart = () => false;
$("at").oninput = update_divider;
if (fragment.has("wipe")) $("at").value = 1000 * fragment.get("wipe");
update_divider();
</script>
)html";

}  // namespace etendue::bench
