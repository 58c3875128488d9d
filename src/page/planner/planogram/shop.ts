// What the page knows of a shop for places of articles: fixtures with their faces and boards, and label types.

import type { StoreDocument } from "../document/document";
import { isObject, valueAt, type Json, type JsonObject } from "../document/json";
import type { Details, Part } from "../document/messages";
import type { Face } from "./mapping";

export interface Holder {
  id: string;
  /** Of its element, which may have copies. */
  path: string;
  /** Whether it has labels at equal distances or the like, and whether they come from its preset. */
  labels: "own" | "preset" | null;
  faces: Face[];
  boards: number;
  /** m */
  length: number;
  depth: number;
}

export interface Shop {
  holders: Map<string, Holder>;
  types: string[];
  unit: { name: string; factor: number };
}

export const lengthOf = ({ length, depth }: Holder, face: Face): number =>
  face === "left" || face === "right" ? depth : length;

/** A label on the top is on no board. */
export const boardsOf = ({ boards }: Holder, face: Face): number => (face === "top" ? 1 : boards);

const sizeOf = (list: Json | undefined): number => (Array.isArray(list) ? list.length : 0);

/** The sides that label_sides in src/shelfbeam/scene/planogram finds; null for a fixture without boards. */
function sidesOf(resolved: JsonObject): Pick<Holder, "faces" | "boards"> | null {
  switch (resolved.type) {
    case "gondola": {
      const boards = sizeOf(resolved.shelves);
      const faces = (["front", "back"] as const).filter(
        (face) => !Array.isArray(resolved.faces) || resolved.faces.includes(face),
      );
      return boards === 0 ? null : { faces, boards };
    }
    case "freezer":
      return { faces: ["front", "back", "left", "right"], boards: 1 };
    case "box":
      return { faces: ["front", "back", "left", "right", "top"], boards: 1 };
    default:
      return null;
  }
}

/** Of a fixture, or of one of its copies. */
export function holderOf({ id, path, footing, unfinished }: Part, details: Details | null): Holder | null {
  const sides = details?.resolved && sidesOf(details.resolved);
  if (!sides || !footing || unfinished || path === null) return null;
  const labels = !isObject(details.effective.labels) ? null : isObject(details.inherited.labels) ? "preset" : "own";
  return { id, path, labels, ...sides, length: footing.length, depth: footing.depth };
}

export async function shopOf(document: StoreDocument): Promise<Shop> {
  const parts = document.parts.all.filter(({ kind, path }) => kind === "fixture" && path !== null);
  const found = await Promise.all(
    parts.map(async (part) => holderOf(part, await document.details.of(part.path as string))),
  );
  const holders = found.flatMap((holder): [string, Holder][] => (holder ? [[holder.id, holder]] : []));
  const own = valueAt(document.json, "/label_types");
  const types = [...(isObject(own) ? Object.keys(own) : []), ...(document.shared.label_types ?? [])];
  return { holders: new Map(holders), types: [...new Set(types)], unit: document.unit };
}
