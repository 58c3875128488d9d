// The snapper of what the plan shows.

import type { StoreDocument } from "../document/document";
import type { Part, Point } from "../document/messages";
import type { Layers } from "../view/layers";
import type { Viewport } from "../view/viewport";
import type { Snapped } from "./choice";
import type { SnapRequest } from "./request";
import { mainDirection, segmentsOf } from "./segments";
import type { LineSource } from "./segment_index";
import { Snapper } from "./snap";

const reach = 10; // pixels

/** What can be seen, and attracts. */
interface Sight {
  document: StoreDocument;
  layers: Layers;
  viewport: Viewport;
}

export class Snapping {
  private parts: readonly Part[] = [];
  private snapper = new Snapper([]);

  /** `beneath`: lines of the picture. */
  constructor(
    private readonly sight: Sight,
    private readonly beneath: LineSource | null = null,
  ) {}

  /** m */
  get reach(): number {
    return reach / this.sight.viewport.scale;
  }

  /** The direction of most walls, degrees. */
  get frame(): number {
    return mainDirection(this.sight.document.parts.all);
  }

  /** `without`: the elements that move themselves, by their paths. It is made again after a change of the others. */
  without(paths: ReadonlySet<string>): Snapper {
    const { document, layers } = this.sight;
    const parts = document.parts.all.filter(
      ({ kind, path }) => layers.isShown(kind) && (path === null || !paths.has(path)),
    );
    if (parts.length === this.parts.length && parts.every((part, k) => part === this.parts[k])) return this.snapper;
    this.parts = parts;
    this.snapper = new Snapper(segmentsOf(parts), this.beneath);
    return this.snapper;
  }

  /** The place of the picture that the pointer means. */
  ofPicture(pointer: Point, isFree: boolean, held?: Snapped): Snapped {
    return new Snapper([], this.beneath).snap({ pointer, reach: this.reach, isFree, held });
  }

  /** The place that the pointer means. */
  at(pointer: Point, request: Omit<SnapRequest, "pointer" | "reach" | "frame">): Snapped {
    const { reach, frame } = this;
    return this.without(new Set()).snap({ ...request, pointer, reach, frame });
  }
}
