import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  GLSL3,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  RawShaderMaterial,
  Sphere,
  Vector2,
} from "three";
import type { Vector } from "./facts";

const vertexShader = `
precision highp float;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform vec2 screen;    // pixels
uniform float width;    // pixels
uniform float nudge;    // so much nearer than it is
in vec2 position;       // x: 0 at the start, 1 at the end; y: -1 and 1 at the sides
in vec3 start;
in vec3 end;
in vec4 paint;          // colour, and how wide
flat out vec3 color;
vec4 nearer(vec3 place) {
  vec4 seen = modelViewMatrix * vec4(place, 1.0);
  // Towards the viewer, not towards the screen: it stays where it is in the picture.
  bool isPerspective = projectionMatrix[2][3] != 0.0;
  if (isPerspective) seen.xyz *= max(0.5, 1.0 - nudge / length(seen.xyz));
  else seen.z += nudge;
  return projectionMatrix * seen;
}
void main() {
  vec4 a = nearer(start);
  vec4 b = nearer(end);
  vec2 along = (b.xy / b.w - a.xy / a.w) * screen;
  along = length(along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
  vec2 aside = vec2(-along.y, along.x);
  vec4 at = mix(a, b, position.x);
  // Longer by half the width at both ends, so that bends are closed.
  vec2 shift = (aside * position.y + along * (position.x - 0.5)) * width * paint.a;
  gl_Position = vec4(at.xy + shift / screen * at.w, at.zw);
  if (a.w <= 0.0 || b.w <= 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  color = paint.rgb;
}`;

const fragmentShader = `
precision highp float;
flat in vec3 color;
out vec4 result;
uniform float alpha;
void main() { result = vec4(color, alpha); }`;

export interface Stroke {
  path: Vector[];
  color: Vector;
  width: number; // 1 is the usual
}

/** Lines of a width in pixels. */
export class Strokes {
  readonly object: Mesh<BufferGeometry, RawShaderMaterial>;

  /**
   * \param nudge how much nearer to the viewer they are drawn than they are, not to sink between the points
   * \param alpha how much of the light counts where they are lit, see EyeDome; 1 elsewhere
   */
  constructor(nudge: number, alpha: number) {
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      side: DoubleSide,
      uniforms: {
        screen: { value: new Vector2(1, 1) },
        width: { value: 2 },
        nudge: { value: nudge },
        alpha: { value: alpha },
      },
    });
    this.object = new Mesh(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  set(strokes: Stroke[]): void {
    const pieces = strokes.reduce((sum, { path }) => sum + Math.max(0, path.length - 1), 0);
    const start = new Float32Array(3 * pieces);
    const end = new Float32Array(3 * pieces);
    const paint = new Float32Array(4 * pieces);
    let piece = 0;
    for (const { path, color, width } of strokes) {
      for (let i = 0; i + 1 < path.length; ++i, ++piece) {
        start.set(path[i], 3 * piece);
        end.set(path[i + 1], 3 * piece);
        paint.set([color[0] / 255, color[1] / 255, color[2] / 255, width], 4 * piece);
      }
    }
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.of(0, -1, 1, -1, 0, 1, 1, 1), 2));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    geometry.setAttribute("start", new InstancedBufferAttribute(start, 3));
    geometry.setAttribute("end", new InstancedBufferAttribute(end, 3));
    geometry.setAttribute("paint", new InstancedBufferAttribute(paint, 4));
    geometry.instanceCount = pieces;
    geometry.boundingSphere = new Sphere();
    this.object.geometry.dispose();
    this.object.geometry = geometry;
    this.object.visible = pieces > 0;
  }

  prepare(width: number, height: number, pixelRatio: number): void {
    this.object.material.uniforms.screen.value.set(width, height);
    this.object.material.uniforms.width.value = 2.2 * pixelRatio;
  }
}
