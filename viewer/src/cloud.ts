import { BufferAttribute, BufferGeometry, GLSL3, Points, RawShaderMaterial, Sphere } from "three";

const vertexShader = `
precision highp float;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform float radius;
uniform float screenHeight;  // pixels
uniform float smallest;      // pixels
uniform float largest;       // pixels; beyond, splats grow more slowly than what they are on
in vec3 position;
in vec4 paint;
flat out vec3 color;
flat out float depth;        // of the middle, in front of the viewer
flat out float bulge;
void main() {
  if (paint.a < 0.5) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 0.0;
    return;
  }
  bool isSharp = paint.a > 1.5;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  // Sharp points need cover no surface, but lie among others: smaller and nearer, they are not half covered.
  float size = isSharp ? 0.8 * radius : radius;
  gl_Position = projectionMatrix * seen;
  float pixelsPerUnit = projectionMatrix[1][1] * screenHeight / gl_Position.w;
  // From afar splats are a closed surface; from near each is a point of its own.
  float pixels = size * pixelsPerUnit;
  if (pixels > largest) pixels = largest + 0.25 * (pixels - largest);
  gl_PointSize = max(isSharp ? 2.0 * smallest : smallest, pixels);
  size = gl_PointSize / pixelsPerUnit;
  depth = -seen.z - (isSharp ? 0.8 * radius : 0.0);
  bulge = size;
  color = paint.rgb / 255.0;
}`;

// A splat is a shallow dome: where two meet, each covers the side that is nearer to it.
const fragmentShader = `
precision highp float;
uniform mat4 projectionMatrix;
flat in vec3 color;
flat in float depth;
flat in float bulge;
out vec4 result;
void main() {
  vec2 place = 2.0 * gl_PointCoord - 1.0;
  float away = dot(place, place);
  if (away > 1.0) discard;
  float z = bulge * (0.3 - 0.3 * away) - depth;
  vec2 clip = mat2(projectionMatrix[2].zw, projectionMatrix[3].zw) * vec2(z, 1.0);
  gl_FragDepth = 0.5 * clip.x / clip.y + 0.5;
  result = vec4(color, 1.0);
}`;

/** Across, in CSS pixels; beyond, splats grow a quarter as fast as what they are on. */
export const largestSplat = 22;

/** The cloud on the graphics card, as round splats. */
export class Cloud {
  readonly object: Points<BufferGeometry, RawShaderMaterial>;
  readonly paint: Uint8Array; // four bytes a point, see paint(); call repaint() after writing
  private readonly geometry = new BufferGeometry();

  /** \param positions three numbers each \param radius of a splat */
  constructor(
    readonly positions: Float32Array,
    private readonly radius: number,
  ) {
    const count = positions.length / 3;
    this.paint = new Uint8Array(4 * count);
    this.geometry.setAttribute("position", new BufferAttribute(positions, 3));
    this.geometry.boundingSphere = new Sphere();
    this.geometry.setAttribute("paint", new BufferAttribute(this.paint, 4));
    this.geometry.setIndex(new BufferAttribute(scattered(count), 1));
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      uniforms: {
        radius: { value: radius },
        screenHeight: { value: 1 },
        smallest: { value: 1 },
        largest: { value: 1 },
      },
    });
    this.object = new Points(this.geometry, material);
    this.object.frustumCulled = false;
  }

  get count(): number {
    return this.paint.length / 4;
  }

  repaint(): void {
    this.geometry.getAttribute("paint").needsUpdate = true;
  }

  /** The next picture shows about so many of the points, evenly chosen, the fewer the larger. */
  prepare(shown: number, screenHeight: number, pixelRatio: number): void {
    const count = Math.min(this.count, Math.ceil(shown));
    this.geometry.setDrawRange(0, count);
    const growth = count > 0 ? Math.min(3, Math.sqrt(this.count / count)) : 1;
    const { uniforms } = this.object.material;
    uniforms.radius.value = this.radius * growth;
    uniforms.screenHeight.value = screenHeight;
    uniforms.smallest.value = 1.6 * pixelRatio;
    uniforms.largest.value = largestSplat * pixelRatio;
  }
}

/** All numbers below count, so that any first few of them are spread evenly over the whole. */
export function scattered(count: number): Uint32Array {
  const order = new Uint32Array(count);
  let stride = Math.max(1, Math.round(count * 0.6180339887498949));
  while (count > 1 && greatestCommonDivisor(stride, count) !== 1) ++stride;
  for (let i = 0, at = 0; i < count; ++i, at = (at + stride) % count) order[i] = at;
  return order;
}

function greatestCommonDivisor(a: number, b: number): number {
  return b === 0 ? a : greatestCommonDivisor(b, a % b);
}
