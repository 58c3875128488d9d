// Lines from the selected label to the units that send it light: the strongest solid, the others thinner and dashed.

import type { Link } from "../../scene/links";
import type { Stage } from "../../scene/stage";
import { selectedLabel } from "../light/facts";
import type { Planner } from "../planner";

const mostRays = 24;
const [strongest, second, least] = [3, 2.2, 0.8]; // pixels

export class Rays {
  private shown = "[]";

  constructor(
    private readonly planner: Planner,
    private readonly stage: Stage,
  ) {}

  update(): void {
    const links = this.links();
    const wanted = JSON.stringify(links);
    if (wanted === this.shown) return;
    this.shown = wanted;
    this.stage.links.set(links);
    this.stage.draw();
  }

  private links(): Link[] {
    const { light, fan, document } = this.planner;
    const label = selectedLabel(this.planner);
    if (label === undefined || label >= document.labels.count || light.isStale) return [];
    const from: Link["from"] = [...fan.place(document.labels, label), document.labels.at(label)[2]];
    return light
      .contributions(label)
      .slice(0, mostRays)
      .flatMap(({ unit, position }, k) => {
        const to = position ?? (unit < document.units.count ? document.units.at(unit) : null);
        if (!to) return [];
        const width = k === 0 ? strongest : Math.max(second - 0.2 * k, least);
        return [{ from, to: [to[0], to[1], to[2]] as Link["to"], solid: k === 0 ? 1 : 0, width }];
      });
  }
}
