// Marks that face the reader: labels and units, one draw call for all marks of one object.

import {
  Color,
  CustomBlending,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  BufferAttribute,
  GLSL3,
  type IUniform,
  Mesh,
  OneFactor,
  ShaderMaterial,
  type Texture,
  Vector2,
  ZeroFactor,
} from "three";

export const mostColours = 20;

/** Shapes as the fragment shader knows them. */
export const shapes = { disc: 0, triangle: 1, square: 2, cross: 3 } as const;

const vertexShader = /* glsl */ `
uniform float worldRadius, lift, spread, pixel;
uniform bool perspective;
uniform vec2 pixelRadius; // least and largest
in vec3 centre;
in vec3 facing;
in vec4 look; // colour, shape, emphasis (0 faint, 1 usual, 2 selected), level
in vec4 ident;
in float number;
out vec2 place;
flat out vec4 mark;
flat out vec4 name;
flat out float digits;
flat out float radius;

void main() {
  mark = look;
  name = ident;
  digits = number;
  vec4 seen = modelViewMatrix * vec4(centre + facing * (lift + spread * look.w), 1.0);
  float size = perspective ? max(-seen.z, 0.01) * pixel : pixel;
  float wide = clamp(worldRadius / size, pixelRadius.x, pixelRadius.y);
  if (look.y == 1.0) wide = max(1.6 * wide, 5.0);
  if (look.y == 3.0) wide *= 0.42;
  if (look.z == 0.0) wide *= 0.75;
  if (look.z == 2.0) wide = max(1.5 * wide, 7.0);
  radius = wide;
  place = position.xy * (1.0 + (wide > 3.0 ? 2.0 : 0.5) / wide);
  vec4 at = seen + vec4(place * wide * size, 0.0, 0.0);
  gl_Position = projectionMatrix * at;
  // In front of the shelf that the label is fixed to, or a tilted view would cut into the mark.
  vec4 nearer = projectionMatrix * (at + vec4(0.0, 0.0, min(wide * size, 0.35), 0.0));
  gl_Position.z = look.z == 2.0 ? -0.999 * gl_Position.w : nearer.z / nearer.w * gl_Position.w;
}`;

const fragmentShader = /* glsl */ `
precision highp float;
uniform vec3 palette[${mostColours}];
uniform vec3 edge, strong, paper;
uniform bool picking;
uniform float threshold; // of coverage; with samples that are covered one by one 0
uniform sampler2D numbers;
uniform vec2 numberGrid;
in vec2 place;
flat in vec4 mark;
flat in vec4 name;
flat in float digits;
flat in float radius;
out vec4 colour;

// Distance to the outline in radii, negative inside.
float outline(vec2 p) {
  if (mark.y == 1.0) return max(abs(p.x) * 0.866 + p.y * 0.5, -p.y) - 0.55;
  if (mark.y == 2.0) return max(abs(p.x), abs(p.y)) - 0.85;
  if (mark.y == 3.0) {
    vec2 q = abs(p);
    return max(max(q.x, q.y) - 0.9, min(q.x, q.y) - 0.16);
  }
  return length(p) - 1.0;
}

void main() {
  float away = outline(place) * radius; // pixels
  if (picking) {
    if (away > 2.0) discard;
    colour = name;
    return;
  }
  float inside = clamp(0.5 - away, 0.0, 1.0);
  if (inside <= threshold) discard;
  bool selected = mark.z == 2.0;
  float line = mark.y == 3.0 && !selected ? 0.0 : selected ? 2.5 : mark.y == 1.0 ? 1.4 : radius > 3.0 ? 0.8 : 0.0;
  vec3 fill = palette[int(mark.x)];
  vec3 border = selected || mark.y == 1.0 ? strong : digits >= 0.0 ? paper : edge;
  vec3 shown = mix(fill, border, clamp(away + line + 0.5, 0.0, 1.0) * step(0.01, line));
  if (digits > 0.5 && radius > 6.0) {
    vec2 cell = vec2(mod(digits, numberGrid.x), floor(digits / numberGrid.x));
    vec2 uv = (cell + vec2(0.5) + vec2(0.46, -0.46) * place) / numberGrid;
    if (all(lessThan(abs(place), vec2(1.0)))) shown = mix(shown, paper, texture(numbers, uv).a);
  }
  if (mark.z == 0.0) shown = mix(paper, shown, 0.55);
  colour = vec4(shown, inside);
}`;

export interface MarkStyle {
  /** Radius in m, kept between two sizes in pixels. */
  worldRadius: number;
  pixels: [number, number];
  /** m along the way a mark faces. */
  lift: number;
  numbers?: { texture: Texture; grid: [number, number] };
}

export class Marks {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private readonly look: InstancedBufferAttribute;
  private readonly number: InstancedBufferAttribute;

  /** `idents` are told by picking. */
  constructor(
    readonly count: number,
    centre: Float32Array,
    facing: Float32Array,
    idents: Uint32Array,
    style: MarkStyle,
  ) {
    const geometry = new InstancedBufferGeometry();
    geometry.instanceCount = count;
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.setAttribute(
      "position",
      new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3),
    );
    geometry.setAttribute("centre", new InstancedBufferAttribute(centre, 3));
    geometry.setAttribute("facing", new InstancedBufferAttribute(facing, 3));
    const bytes = new Uint8Array(idents.buffer, idents.byteOffset, idents.byteLength);
    geometry.setAttribute("ident", new InstancedBufferAttribute(bytes, 4, true));
    this.look = new InstancedBufferAttribute(new Uint8Array(4 * count), 4);
    this.number = new InstancedBufferAttribute(new Float32Array(count).fill(-1), 1);
    geometry.setAttribute("look", this.look.setUsage(DynamicDrawUsage));
    geometry.setAttribute("number", this.number);
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      alphaToCoverage: true,
      // The picture itself stays opaque: what alpha says is only which samples are covered.
      blending: CustomBlending,
      blendSrc: OneFactor,
      blendDst: ZeroFactor,
      blendSrcAlpha: ZeroFactor,
      blendDstAlpha: OneFactor,
      uniforms: {
        worldRadius: { value: style.worldRadius },
        pixelRadius: { value: new Vector2(...style.pixels) },
        lift: { value: style.lift },
        spread: { value: 0 },
        pixel: { value: 1 },
        perspective: { value: true },
        palette: { value: Array.from({ length: mostColours }, () => new Color()) },
        edge: { value: new Color() },
        strong: { value: new Color() },
        paper: { value: new Color() },
        picking: { value: false },
        threshold: { value: 0 },
        numbers: { value: style.numbers?.texture ?? null },
        numberGrid: { value: new Vector2(...(style.numbers?.grid ?? [1, 1])) },
      },
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  uniform(name: string): IUniform {
    return this.mesh.material.uniforms[name];
  }

  setPalette(colours: Color[], others: { edge: Color; strong: Color; paper: Color }): void {
    const palette = this.uniform("palette").value as Color[];
    colours.slice(0, mostColours).forEach((colour, k) => palette[k].copy(colour));
    for (const [name, colour] of Object.entries(others)) (this.uniform(name).value as Color).copy(colour);
  }

  setLook(mark: number, colour: number, shape: number, emphasis: number, level: number): void {
    this.look.setXYZW(mark, colour, shape, emphasis, level);
  }

  /** A cell of the number texture; -1: a label, 0: nothing written. */
  setNumber(mark: number, cell: number): void {
    this.number.setX(mark, cell);
  }

  upload(): void {
    this.look.needsUpdate = true;
    this.number.needsUpdate = true;
  }
}
