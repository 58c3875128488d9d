import assert from "node:assert/strict";
import { test } from "node:test";

import { EditBuilder } from "../../../../src/page/planner/document/edit";
import { addFaces, carrierAt, lookOf } from "../../../../src/page/planner/make/faces";
import { addRail, ceilingAt } from "../../../../src/page/planner/make/rail";
import { wallLines } from "../../../../src/page/planner/make/walls";
import { part, points, rectangle, site } from "./support.mjs";

const room = { size: [20, 15, 3.5], floor: "f", ceiling: "c", walls: "w" };
const zones = [{ id: "bakery", polygon: rectangle(0, 10, 6, 15), height: 2.6 }];
const rail = { id: "R1", type: "t", below: 0.05, spacing: 0.5 };
const line = points("1,1 7,1 7,4");

test("a rail hangs below the ceiling, with its corners", () => {
  const builder = new EditBuilder({ room });
  assert.equal(addRail(builder, site({ room }), line, rail), "/transceivers/rails/0");
  assert.deepEqual(builder.json.transceivers.rails[0], {
    type: "t",
    id: "R1",
    points: points("1,1,3.45 7,1,3.45 7,4,3.45"),
    spacing: 0.5,
  });
  assert.equal(addRail(new EditBuilder({}), site({}), line, rail), null, "without a room");
});

test("a rail stays below the lowest ceiling that it passes", () => {
  const json = { room: { ...room, zones } };
  const heightOf = (...points) => {
    const builder = new EditBuilder(json);
    addRail(builder, site(json), points, rail);
    return builder.json.transceivers.rails[0].points[0][2];
  };
  assert.equal(heightOf([1, 1], [9, 1]), 3.45);
  assert.equal(heightOf([1, 1], [1, 12]), 2.55);
  assert.equal(heightOf([6, 9], [12, 15]), 3.45, "past the corner of the zone");
  assert.equal(heightOf([2, 9], [8, 14]), 2.55, "across its corner, with both ends outside");
});

test("the height of flat and sloped ceilings, also in feet", () => {
  const sloped = points("0,0,3 10,0,4 0,10,3");
  const json = { room: { outline: rectangle(0, 0, 10, 10), height: sloped } };
  assert.ok(Math.abs(ceilingAt(site(json), [5, 7]) - 3.5) < 1e-12);
  assert.ok(Math.abs(ceilingAt(site(json, "ft"), [5 * 0.3048, 1]) - 3.5 * 0.3048) < 1e-12);
  const builder = new EditBuilder(json);
  addRail(builder, site(json), points("2,5 8,5"), rail);
  assert.equal(builder.json.transceivers.rails[0].points[1][2], 3.15, "horizontal, as the lower end");
  assert.equal(ceilingAt(site({ room: { height: [1, 2] } }), [0, 0]), null);
});

const parts = [
  part("A1", "fixture", rectangle(2, 2, 8, 3), { height: 1.8 }),
  part("column", "fixture", rectangle(10, 5, 10.5, 5.5), { height: 3 }),
  part("W1", "wall", rectangle(12, 2, 12.1, 8), { height: 3 }),
  part("", "room", rectangle(0, 0, 20, 15), { height: 3 }),
];
const at = (x, y) => carrierAt(parts, wallLines(site({ room })), [x, y]);

test("the fixture, inner wall or wall of the room at the pointer, and its face", () => {
  const named = (x, y) => {
    const found = at(x, y);
    return found && [found.key, found.name, found.face];
  };
  assert.deepEqual(named(5, 2.1), ["fixture", "A1", "south"]);
  assert.deepEqual(named(5, 3.2), ["fixture", "A1", "north"], "in front of it");
  assert.deepEqual(named(10.45, 5.2), ["fixture", "column", "east"]);
  assert.deepEqual(named(11.8, 4), ["inner_wall", "W1", "west"]);
  assert.deepEqual(named(5, 0.1), ["wall", 0, null]);
  assert.deepEqual(named(19.9, 7), ["wall", 1, null]);
  assert.equal(named(15, 10), null, "in the open");
  assert.equal(at(5, 2.1).faceEdges.length, 1);
  assert.equal(at(5, 2.1).edges.length, 4);
});

test("faces by the compass: less than 45 degrees from it, in either direction of the outline", () => {
  const turned = (degrees) => {
    const angle = (degrees * Math.PI) / 180;
    return [
      [0, 0],
      [Math.cos(angle), Math.sin(angle)],
    ];
  };
  const looks = Object.entries({ 0: "south", 44: "south", 46: "east", 45: null, "-44": "south", "-90": "west" });
  for (const [degrees, look] of looks) assert.equal(lookOf(turned(degrees), true), look);
  assert.equal(lookOf(turned(0), false), "north");
  // A quarter of a column belongs to each side.
  const round = Array.from({ length: 24 }, (_, k) => [
    5 + Math.cos((k * Math.PI) / 12 + 0.1),
    5 + Math.sin((k * Math.PI) / 12 + 0.1),
  ]);
  const [found] = [carrierAt([part("pipe", "fixture", round)], [], [6.1, 5])];
  assert.equal(found.face, "east");
  assert.equal(found.faceEdges.length, 6);
});

const form = { type: "t", isAround: true, z: 2.4, spacing: 1, tilt: 30 };

test("candidates on faces, with an id where the usual one is taken", () => {
  const json = { transceivers: { rails: [{ id: "column-east" }] } };
  const builder = new EditBuilder(json);
  const add = (x, y, more = {}) => addFaces(builder, site(json), at(x, y), { ...form, ...more });
  assert.equal(add(10.45, 5.2), "/transceivers/on/0");
  add(10.45, 5.2, { isAround: false, tilt: 0 });
  add(10.45, 5.2, { isAround: false });
  add(5, 2.1);
  add(5, 0.1);
  add(5, 0.1);
  add(11.8, 4, { isAround: false });
  assert.deepEqual(builder.json.transceivers.on, [
    { type: "t", fixture: "column", z: 2.4, spacing: 1, tilt_deg: 30 },
    { type: "t", id: "column-east-2", fixture: "column", face: "east", z: 2.4, spacing: 1 },
    { type: "t", id: "column-east-3", fixture: "column", face: "east", z: 2.4, spacing: 1, tilt_deg: 30 },
    { type: "t", fixture: "A1", z: 1.7, spacing: 1, tilt_deg: 30 },
    { type: "t", wall: 0, z: 2.4, spacing: 1, tilt_deg: 30 },
    { type: "t", id: "wall-0-2", wall: 0, z: 2.4, spacing: 1, tilt_deg: 30 },
    { type: "t", inner_wall: "W1", face: "west", z: 2.4, spacing: 1, tilt_deg: 30 },
  ]);
});
