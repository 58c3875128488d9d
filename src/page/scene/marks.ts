// Marks that face the reader: labels and units, instanced, one draw call for all marks of one object.
//
// An instance is a block of marks that read their properties from textures. One instance per mark would leave most of a
// GPU idle and make software rendering ten times slower.

import {
  BufferAttribute,
  Color,
  CustomBlending,
  DataTexture,
  FloatType,
  GLSL3,
  InstancedBufferGeometry,
  type IUniform,
  Mesh,
  OneFactor,
  OneMinusSrcAlphaFactor,
  type PixelFormat,
  RGBAFormat,
  RGBAIntegerFormat,
  ShaderMaterial,
  type Texture,
  type TextureDataType,
  UnsignedByteType,
  Vector2,
  ZeroFactor,
} from "three";

const block = 64; // marks per instance
const rowLength = 1024; // texels

export const mostColours = 20;

/** Shapes, numbered as in the fragment shader. */
export const shapes = { disc: 0, triangle: 1, square: 2, cross: 3, diamond: 4, none: 5 } as const;

/** What is added to a shape: stripes, a hole in the middle, paler colours. */
export const patterns = { none: 0, hatched: 16, hollow: 32, pale: 64 } as const;

const vertexShader = /* glsl */ `
uniform float worldRadius, lift, spread, pixel;
uniform bool perspective;
uniform vec2 pixelRadius; // minimum and maximum
uniform int count;
uniform sampler2D centres; // and number
uniform sampler2D facings;
uniform highp usampler2D looks; // colour, shape and patterns, emphasis (0 faint, 1 usual, 2 selected, 3 in front), level
uniform sampler2D idents;
out vec2 place;
flat out vec4 mark;
flat out int pattern;
flat out vec4 name;
flat out float digits;
flat out float radius;

void main() {
  int index = gl_InstanceID * ${block} + gl_VertexID / 4;
  if (index >= count) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  ivec2 texel = ivec2(index % ${rowLength}, index / ${rowLength});
  vec4 centre = texelFetch(centres, texel, 0);
  vec3 facing = texelFetch(facings, texel, 0).xyz;
  uvec4 coded = texelFetch(looks, texel, 0);
  pattern = int(coded.y);
  vec4 look = vec4(coded.x, coded.y & 15u, coded.zw);
  if (look.y == 5.0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  mark = look;
  name = texelFetch(idents, texel, 0);
  digits = centre.w;
  vec4 seen = modelViewMatrix * vec4(centre.xyz + facing * (lift + spread * look.w), 1.0);
  float size = perspective ? max(-seen.z, 0.01) * pixel : pixel;
  float wide = clamp(worldRadius / size, pixelRadius.x, pixelRadius.y);
  bool special = look.y == 1.0 || (look.y == 2.0 && digits < 0.0);
  if (special) wide = max(1.6 * wide, 5.0);
  if (look.y == 3.0) wide *= 0.42;
  if (look.z == 0.0) wide *= 0.75;
  if (look.z == 2.0) wide = max(1.5 * wide, 7.0);
  radius = wide;
  place = position.xy * (1.0 + (wide > 3.0 ? 2.0 : 0.5) / wide);
  vec4 at = seen + vec4(place * wide * size, 0.0, 0.0);
  gl_Position = projectionMatrix * at;
  // In front of the shelf, which would otherwise cut into the mark in a tilted view.
  vec4 nearer = projectionMatrix * (at + vec4(0.0, 0.0, min(wide * size, 0.35), 0.0));
  gl_Position.z = look.z >= 2.0 ? -0.999 * gl_Position.w : nearer.z / nearer.w * gl_Position.w;
}`;

const fragmentShader = /* glsl */ `
precision highp float;
uniform vec3 palette[${mostColours}];
uniform vec3 edge, strong, paper;
uniform bool picking, overlay;
uniform float threshold; // of coverage; 0 with multisampling
uniform sampler2D numbers;
uniform vec2 numberGrid;
in vec2 place;
flat in vec4 mark;
flat in int pattern;
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
  if (mark.y == 4.0) return (abs(p.x) + abs(p.y) - 1.15) * 0.71;
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
  bool special = mark.y == 1.0 || (mark.y == 2.0 && digits < 0.0);
  float line = mark.y == 3.0 && !selected ? 0.0 : selected ? 2.5 : special ? 1.4 : radius > 3.0 ? 0.8 : 0.0;
  vec3 fill = palette[int(mark.x)];
  vec2 pixels = place * radius;
  if ((pattern & ${patterns.hatched}) != 0 && fract((pixels.x + pixels.y) / 4.4 + 0.25) > 0.5) fill = paper;
  if ((pattern & ${patterns.hollow}) != 0) {
    float deep = radius * (mark.y == 1.0 ? 0.55 : mark.y == 2.0 ? 0.85 : 1.0); // from the outline to the middle
    fill = mix(fill, paper, clamp(max(0.9, 0.38 * deep) - deep - away + 0.5, 0.0, 1.0));
    if (!selected) line = min(line, 0.9);
  }
  vec3 border = selected || special ? strong : digits >= 0.0 ? paper : edge;
  vec3 shown = mix(fill, border, clamp(away + line + 0.5, 0.0, 1.0) * step(0.01, line));
  if (digits > 0.5 && radius > 6.0) {
    vec2 cell = vec2(mod(digits, numberGrid.x), floor(digits / numberGrid.x));
    vec2 uv = (cell + vec2(0.5) + vec2(0.46, -0.46) * place) / numberGrid;
    if (all(lessThan(abs(place), vec2(1.0)))) shown = mix(shown, paper, texture(numbers, uv).a);
  }
  if (mark.z == 0.0) shown = mix(paper, shown, 0.55);
  if ((pattern & ${patterns.pale}) != 0) shown = mix(paper, shown, 0.38);
  colour = vec4(overlay ? shown * inside : shown, inside);
}`;

/** Four numbers per mark. */
function texture(data: Float32Array | Uint8Array, format: PixelFormat, type: TextureDataType): DataTexture {
  const made = new DataTexture(data, rowLength, data.length / (4 * rowLength), format, type);
  made.needsUpdate = true;
  return made;
}

/** x, y, z of every mark as texels. */
function texels(values: Float32Array, count: number, length: number, last: number): Float32Array {
  const data = new Float32Array(length);
  for (let k = 0; k < count; ++k) {
    data.set(values.subarray(3 * k, 3 * k + 3), 4 * k);
    data[4 * k + 3] = last;
  }
  return data;
}

/** A block of quads. */
function blockGeometry(): InstancedBufferGeometry {
  const corners = [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0];
  const geometry = new InstancedBufferGeometry();
  const positions = new Float32Array(12 * block);
  const index: number[] = [];
  for (let quad = 0; quad < block; ++quad) {
    positions.set(corners, 12 * quad);
    index.push(...[0, 1, 2, 0, 2, 3].map((corner) => 4 * quad + corner));
  }
  geometry.setIndex(index);
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  return geometry;
}

export interface MarkStyle {
  /** Radius in m, kept between two sizes in pixels. */
  worldRadius: number;
  pixels: [number, number];
  /** Offset in m along the direction that a mark faces. */
  lift: number;
  numbers?: { texture: Texture; grid: [number, number] };
}

export class Marks {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  /** Four numbers per mark, as in the textures. */
  readonly places: Float32Array;
  readonly facings: Float32Array;
  readonly looks: Uint8Array;
  private isChanged = false;
  private readonly textures: { centres: DataTexture; facings: DataTexture; looks: DataTexture; idents: DataTexture };

  /** Picking returns `idents`. */
  constructor(
    readonly count: number,
    centre: Float32Array,
    facing: Float32Array,
    idents: Uint32Array,
    style: MarkStyle,
  ) {
    const geometry = blockGeometry();
    geometry.instanceCount = Math.ceil(count / block);
    const length = 4 * rowLength * Math.max(1, Math.ceil(count / rowLength));
    const names = new Uint8Array(length);
    names.set(new Uint8Array(idents.buffer, idents.byteOffset, idents.byteLength));
    this.places = texels(centre, count, length, -1);
    this.facings = texels(facing, count, length, 0);
    this.looks = new Uint8Array(length);
    this.textures = {
      centres: texture(this.places, RGBAFormat, FloatType),
      facings: texture(this.facings, RGBAFormat, FloatType),
      looks: texture(this.looks, RGBAIntegerFormat, UnsignedByteType),
      idents: texture(names, RGBAFormat, UnsignedByteType),
    };
    this.textures.looks.internalFormat = "RGBA8UI";
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      blending: CustomBlending,
      blendSrc: OneFactor,
      uniforms: {
        count: { value: count },
        ...Object.fromEntries(Object.entries(this.textures).map(([name, value]) => [name, { value }])),
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
        overlay: { value: false },
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

  /** `shape`: perhaps with patterns. */
  setLook(mark: number, colour: number, shape: number, emphasis: number, level: number): void {
    const { looks } = this;
    const at = 4 * mark;
    if (looks[at] === colour && looks[at + 1] === shape && looks[at + 2] === emphasis && looks[at + 3] === level)
      return;
    looks[at] = colour;
    looks[at + 1] = shape;
    looks[at + 2] = emphasis;
    looks[at + 3] = level;
    this.isChanged = true;
  }

  /** A cell of the number texture; -1: a label, 0: no number. */
  setNumber(mark: number, cell: number): void {
    this.places[4 * mark + 3] = cell;
  }

  /** Moves a mark; `uploadPlaces` shows it. */
  place(mark: number, centre: readonly number[], facing: readonly number[]): void {
    this.places.set(centre, 4 * mark);
    this.facings.set(facing, 4 * mark);
  }

  uploadPlaces(): void {
    this.uploadNumbers();
    this.textures.facings.needsUpdate = true;
  }

  /** For a picture without background (`overlay`) or an opaque one, where alpha only selects the covered samples. */
  blend(overlay: boolean, multisampled: boolean): void {
    const { material } = this.mesh;
    this.uniform("overlay").value = overlay;
    this.uniform("threshold").value = overlay || multisampled ? 0 : 0.5;
    material.alphaToCoverage = multisampled && !overlay;
    material.blendDst = overlay ? OneMinusSrcAlphaFactor : ZeroFactor;
    material.blendSrcAlpha = overlay ? OneFactor : ZeroFactor;
    material.blendDstAlpha = overlay ? OneMinusSrcAlphaFactor : OneFactor;
    material.needsUpdate = true;
  }

  dispose(): void {
    for (const texture of Object.values(this.textures)) texture.dispose();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }

  /** Shows changed looks. */
  upload(): void {
    if (this.isChanged) this.textures.looks.needsUpdate = true;
    this.isChanged = false;
  }

  uploadNumbers(): void {
    this.textures.centres.needsUpdate = true;
  }
}
