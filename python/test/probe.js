// What a test asks of the page of a report: (q) => ..., q: a configuration of the first arm, or []. Moves the sliders, chooses other runs, and sorts
// the first table.
(q) => {
  const seen = (canvas) => {
    const small = Object.assign(document.createElement("canvas"), {width: 80, height: 60}), c = small.getContext("2d");
    c.drawImage(canvas, 0, 0, 80, 60);
    return [...c.getImageData(0, 0, 80, 60).data];
  };
  const differ = (a, b) => a.filter((v, i) => Math.abs(v - b[i]) > 8).length;
  const views = [...document.querySelectorAll(".view")].map((view) => {
    const canvas = view.querySelector("canvas"), before = seen(canvas), slider = view.querySelector("input[type=range]");
    let moved = null, chosen = null, sight = [];
    if (slider) {
      slider.value = Number(slider.min) + 0.8 * (slider.max - slider.min);
      slider.dispatchEvent(new Event("input"));
      moved = differ(before, seen(canvas));
      sight = view.vispView ? view.vispView.scene.runs.slice(0, 2).map((_, i) => view.vispView.see(i)) : [];
    }
    const menu = view.querySelector("select");
    if (menu) { // another run on the left, and back
      const was = menu.value, first = seen(canvas);
      const choose = (value) => { menu.value = value; menu.dispatchEvent(new Event("change")); return differ(first, seen(canvas)); };
      chosen = [choose([...menu.options].map((o) => o.value).find((v) => v !== was)), choose(was)];
    }
    const run = view.vispView && view.vispView.scene.runs[0], k = run ? Math.floor(0.1 * run.t.length) : 0;
    const carried = run && run.camera && q.length ? [view.vispView.toolAt(0, run.q[k]), [3, 7, 11].map((i) => run.camera.pose[k][i])] : [];
    return {carried, tool: q.length && view.vispView ? view.vispView.toolAt(0, q) : [], colours: new Set(before.map((v, i) => i % 4 ? 0 : before.slice(i, i + 3).join())).size,
            moved, chosen, sight};
  });
  const table = document.querySelector("table.sorts"), rows = () => [...table.tBodies[0].rows].map((r) => r.cells[1].textContent);
  const unsorted = rows();
  table.querySelectorAll("th")[1].click();
  return {views, sorted: rows(), unsorted, wide: document.documentElement.scrollWidth - window.innerWidth,
          figures: document.querySelectorAll("figure.plot svg").length};
}
