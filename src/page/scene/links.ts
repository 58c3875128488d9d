// Lines from a label to the units that it receives: the direct part solid, the reflected part dashed.

import {
  BufferAttribute,
  Color,
  GLSL3,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  ShaderMaterial,
  Vector2,
} from "three";

export interface Link {
  from: [number, number, number];
  to: [number, number, number];
  /** The solid share of the length, from `from`; the rest is dashed. Null: not known, one solid line. */
  solid: number | null;
  /** Pixels. */
  width: number;
}

const vertexShader = /* glsl */ `
uniform vec2 view; // pixels
in vec3 start;
in vec3 end;
in vec2 style; // solid share, width
out float along;
flat out float solid;
flat out float metres;

void main() {
  vec4 a = projectionMatrix * modelViewMatrix * vec4(start, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(end, 1.0);
  // Parts behind the camera are clipped at the near plane.
  float near = 0.02;
  float first = 0.0, last = 1.0;
  if (a.w < near && b.w > near) { first = (near - a.w) / (b.w - a.w); a = mix(a, b, first); }
  else if (b.w < near && a.w > near) { float t = (near - a.w) / (b.w - a.w); b = mix(a, b, t); last = t; }
  vec2 way = (b.xy / b.w - a.xy / a.w) * view;
  vec2 across = length(way) > 0.0 ? normalize(vec2(-way.y, way.x)) : vec2(1.0, 0.0);
  vec4 at = position.x < 0.5 ? a : b;
  at.xy += across * position.y * style.y / view * at.w;
  gl_Position = at;
  along = position.x < 0.5 ? first : last;
  solid = style.x;
  metres = distance(start, end);
}`;

const fragmentShader = /* glsl */ `
precision highp float;
uniform vec3 direct, reflected, unknown;
in float along;
flat in float solid;
flat in float metres;
out vec4 colour;

void main() {
  if (solid < 0.0) {
    colour = vec4(unknown, 1.0);
    return;
  }
  bool through = along < solid;
  if (!through && fract((along - solid) * metres / 0.28) > 0.62) discard;
  colour = vec4(through ? direct : reflected, 1.0);
}`;

export class Links {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  shown: readonly Link[] = [];

  constructor() {
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      depthTest: false,
      transparent: true,
      uniforms: {
        view: { value: new Vector2(1, 1) },
        direct: { value: new Color() },
        reflected: { value: new Color() },
        unknown: { value: new Color() },
      },
    });
    this.mesh = new Mesh(Links.geometry([]), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 5;
    this.mesh.visible = false;
  }

  set(links: Link[]): void {
    this.shown = links;
    this.mesh.geometry.dispose();
    this.mesh.geometry = Links.geometry(links);
    this.mesh.visible = links.length > 0;
  }

  private static geometry(links: Link[]): InstancedBufferGeometry {
    const geometry = new InstancedBufferGeometry();
    geometry.instanceCount = links.length;
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const corners = new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]);
    geometry.setAttribute("position", new BufferAttribute(corners, 3));
    const numbers = (of: (link: Link) => number[]) => new Float32Array(links.flatMap(of));
    geometry.setAttribute(
      "start",
      new InstancedBufferAttribute(
        numbers((link) => link.from),
        3,
      ),
    );
    geometry.setAttribute(
      "end",
      new InstancedBufferAttribute(
        numbers((link) => link.to),
        3,
      ),
    );
    geometry.setAttribute(
      "style",
      new InstancedBufferAttribute(
        numbers((link) => [link.solid ?? -1, link.width]),
        2,
      ),
    );
    return geometry;
  }
}
