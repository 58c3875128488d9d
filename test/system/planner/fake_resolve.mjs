// A crude resolution of a store, until the server does it: outlines, labels and candidates, without checks.

const factors = { m: 1, cm: 0.01, mm: 0.001, ft: 0.3048, in: 0.0254 };
const formOf = { gondola: "rack", freezer: "chest" };

const merged = (base, own) => {
  const result = { ...base };
  for (const [key, value] of Object.entries(own)) {
    const isObject = (x) => typeof x === "object" && x !== null && !Array.isArray(x);
    result[key] = isObject(value) && isObject(base[key]) ? merged(base[key], value) : value;
  }
  return result;
};

export function effective(json, element) {
  const preset = element.preset && json.presets?.[element.preset];
  if (!preset) return { ...element };
  const { preset: _name, ...own } = element;
  return merged(effective(json, preset), own);
}

const turned = ([x, y], degrees) => {
  const a = (degrees * Math.PI) / 180;
  const [c, s] = degrees % 90 === 0 ? [Math.round(Math.cos(a)), Math.round(Math.sin(a))] : [Math.cos(a), Math.sin(a)];
  return [c * x - s * y, s * x + c * y];
};
const plus = (a, b) => a.map((value, k) => value + b[k]);

function rectangle(at, rotation, length, depth) {
  return [
    [0, 0],
    [length, 0],
    [length, depth],
    [0, depth],
  ].map((corner) => plus(at.slice(0, 2), turned(corner, rotation)));
}

function footingOf(value, walls) {
  const [length, depth] = value.size ?? [value.length, value.depth];
  if (!value.against) return { at: value.at.slice(0, 2), rotation: value.rotation_deg ?? 0, length, depth };
  const wall = walls[value.against.wall ?? 0];
  if (!wall) return null;
  const [a, b] = wall;
  const way = [b[0] - a[0], b[1] - a[1]];
  const size = Math.hypot(...way);
  const u = way.map((x) => x / size);
  const inward = [-u[1], u[0]];
  const start = (value.against.from ?? 0) + length;
  const gap = value.against.gap ?? 0;
  const at = [0, 1].map((k) => a[k] + start * u[k] + (gap + depth) * inward[k]);
  const rotation = (Math.atan2(-u[1], -u[0]) * 180) / Math.PI;
  return { at, rotation: (rotation + 360) % 360, length, depth, along: u };
}

function copiesOf(value) {
  const { repeat } = value;
  if (!repeat) return [{ shift: [0, 0], number: 1 }];
  const vector = (step) => (Array.isArray(step) ? step : turned([step ?? 0, 0], value.rotation_deg ?? 0));
  const copies = [];
  for (let row = 0; row < (repeat.count2 ?? 1); ++row)
    for (let k = 0; k < repeat.count; ++k) {
      const shift = [0, 1].map((axis) => k * vector(repeat.step)[axis] + row * vector(repeat.step2)[axis]);
      copies.push({ shift, number: copies.length + (repeat.first ?? 1) });
    }
  return copies;
}

function fixtureParts(json, element, index, walls, f) {
  const value = effective(json, element);
  const copies = copiesOf(value);
  return copies.map(({ shift, number }, copy) => {
    const part = {
      key: copies.length > 1 ? `fixtures/${index}#${copy + 1}` : `fixtures/${index}`,
      path: `/fixtures/${index}`,
      kind: "fixture",
      type: value.type,
      id: value.id.replaceAll("{n}", number),
      form: formOf[value.type] ?? "block",
      height:
        (value.height ?? value.size?.[2] ?? value.max?.[2] ?? (typeof value.top === "number" ? value.top : 2)) * f,
      rotation: value.rotation_deg ?? 0,
      locked: copies.length > 1 ? "repeat" : null,
    };
    let outline;
    if (value.type === "prism") outline = value.polygon;
    else if (value.type === "cylinder")
      outline = Array.from({ length: 32 }, (_, k) =>
        plus(value.at, [value.radius * Math.cos((k * Math.PI) / 16), value.radius * Math.sin((k * Math.PI) / 16)]),
      );
    else if (value.type === "panel") {
      const [a, b, c] = value.corners;
      outline = [a, b, c, a.map((x, k) => x + c[k] - b[k])].map((corner) => corner.slice(0, 2));
    } else if (value.min) {
      const [a, b] = [value.min, value.max];
      outline = [
        [a[0], a[1]],
        [b[0], a[1]],
        [b[0], b[1]],
        [a[0], b[1]],
      ];
    } else if (value.type === "mesh") outline = rectangle(value.at, value.rotation_deg ?? 0, 3.4, 0.8);
    else {
      const footing = footingOf(value, walls);
      if (!footing) return null;
      const { along, ...own } = footing;
      const at = plus(own.at, along ? along.map((u) => u * copy * (value.repeat?.step ?? 0)) : shift);
      part.footing = { ...own, at: at.map((x) => x * f), length: own.length * f, depth: own.depth * f };
      part.rotation = own.rotation;
      if (along) part.against = { along };
      part.outline = rectangle(part.footing.at, own.rotation, part.footing.length, part.footing.depth);
      return { part, value };
    }
    part.outline = outline.map((corner) => plus(corner, shift).map((x) => x * f));
    return { part, value };
  });
}

/** Labels along the edges of a gondola or freezer. */
function labelsOf({ part: { footing }, value }, index, f, labels) {
  if (!footing || !value.labels || Array.isArray(value.labels)) return;
  const { spacing = 1, count, faces = value.faces ?? ["front", "back"] } = value.labels;
  const levels = value.shelves ?? [value.height - 0.05];
  const many = count ?? Math.max(1, Math.floor(footing.length / (spacing * f)));
  const step = count ? footing.length / count : spacing * f;
  for (const face of faces)
    levels.forEach((z, level) => {
      for (let k = 0; k < many; ++k) {
        const x = 0.5 * footing.length + (k - 0.5 * (many - 1)) * step;
        const y = face === "front" ? -0.01 : footing.depth + 0.01;
        const [u, v] = plus(footing.at, turned([x, y], footing.rotation));
        const normal = turned([0, face === "front" ? -1 : 1], footing.rotation);
        labels.push({
          id: `${value.id}-${face}-${level + 1}-${k + 1}`,
          type: value.labels.type,
          at: [u, v, z * f],
          normal: [...normal, 0],
          level,
          kind: 1,
          source: index,
        });
      }
    });
}

export function resolve(json) {
  const f = factors[json.units ?? "m"];
  const scaled = (points) => points.map((point) => point.map((x) => x * f));
  const parts = [];
  const labels = [];
  const units = [];
  const problems = [];
  const { room, transceivers = {} } = json;
  let outline = [];
  if (room) {
    const [x, y] = room.size ?? [];
    outline = room.outline ?? [
      [0, 0],
      [x, 0],
      [x, y],
      [0, y],
    ];
    const height = room.size?.[2] ?? (typeof room.height === "number" ? room.height : 3);
    parts.push({
      key: "room",
      path: "/room",
      kind: "room",
      id: "",
      outline: scaled(outline),
      holes: (room.holes ?? []).map(scaled),
      height: height * f,
    });
    room.zones?.forEach(({ id, polygon }, k) =>
      parts.push({
        key: `zones/${k}`,
        path: `/room/zones/${k}`,
        kind: "zone",
        id,
        outline: scaled(polygon),
        height: 2.5,
      }),
    );
    room.inner_walls?.forEach(({ id, from, to, thickness = 0.1 / f, height }, k) => {
      const way = [to[0] - from[0], to[1] - from[1]];
      const size = Math.hypot(...way) || 1;
      const n = [(-way[1] / size) * thickness * 0.5, (way[0] / size) * thickness * 0.5];
      const corners = [
        plus(
          from,
          n.map((x) => -x),
        ),
        plus(
          to,
          n.map((x) => -x),
        ),
        plus(to, n),
        plus(from, n),
      ];
      parts.push({
        key: `walls/${k}`,
        path: `/room/inner_walls/${k}`,
        kind: "wall",
        id,
        outline: scaled(corners),
        height: typeof height === "number" ? height * f : 3,
      });
    });
  }
  const walls = outline.map((corner, k) => [corner, outline[(k + 1) % outline.length]]);
  json.fixtures?.forEach((element, index) => {
    try {
      for (const found of fixtureParts(json, element, index, walls, f)) {
        if (!found) throw new Error("has no place");
        parts.push(found.part);
        labelsOf(found, index, f, labels);
      }
      const value = effective(json, element);
      for (const key of ["length", "depth"])
        if (value[key] > 1000)
          problems.push({
            code: "too_large",
            path: `fixtures[${index}].${key}`,
            pointer: `/fixtures/${index}`,
            sentence: `must be at most 1000, not ${value[key]}`,
          });
    } catch (error) {
      problems.push({
        code: "unreadable",
        path: `fixtures[${index}]`,
        pointer: `/fixtures/${index}`,
        sentence: `cannot be read: ${error.message}`,
      });
    }
  });
  if (Array.isArray(json.labels))
    json.labels.forEach(({ id, type, position, normal }, source) =>
      labels.push({ id, type, at: position.map((x) => x * f), normal, level: 0, kind: 0, source }),
    );
  const area = (list, kind, outlineOf) =>
    list?.forEach((element, k) =>
      parts.push({
        key: `${kind}s/${k}`,
        path: `/transceivers/${{ grid: "grids", area: "areas", rail: "rails", keep_out: "keep_out" }[kind]}/${k}`,
        kind,
        id: element.id ?? "",
        outline: scaled(outlineOf(element)),
      }),
    );
  const box = ({ min: [x, y], max: [u, v] }) => [
    [x, y],
    [u, y],
    [u, v],
    [x, v],
  ];
  area(transceivers.grids, "grid", box);
  area(transceivers.keep_out, "keep_out", (element) => element.polygon ?? box(element));
  area(transceivers.areas, "area", (element) =>
    Array.isArray(element.area)
      ? element.area
      : (room?.zones?.find(({ id }) => id === element.area)?.polygon ?? outline),
  );
  area(transceivers.rails, "rail", ({ points }) => points.map((point) => point.slice(0, 2)));
  const state = (id) =>
    transceivers.installed?.includes(id)
      ? 1
      : transceivers.pinned?.includes(id)
        ? 2
        : transceivers.excluded?.includes(id)
          ? 3
          : 0;
  transceivers.grids?.forEach(({ min, max, spacing, z, axis = [0, 0, -1], type }, source) => {
    const counts = [0, 1].map((k) => Math.max(1, Math.round((max[k] - min[k]) / spacing)));
    for (let i = 0; i <= counts[0]; ++i)
      for (let j = 0; j <= counts[1]; ++j) {
        const id = `G${source + 1}-${i + 1}-${j + 1}`;
        const at = [min[0] + (i * (max[0] - min[0])) / counts[0], min[1] + (j * (max[1] - min[1])) / counts[1], z];
        units.push({ id, type, at: at.map((x) => x * f), normal: axis, level: state(id), kind: 1, source });
      }
  });
  if (Array.isArray(transceivers.list))
    transceivers.list.forEach(({ id, type, position, axis = [0, 0, -1] }, source) =>
      units.push({ id, type, at: position.map((x) => x * f), normal: axis, level: state(id), kind: 0, source }),
    );
  return { parts, labels, units, problems };
}
