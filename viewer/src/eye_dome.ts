import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DepthTexture,
  FloatType,
  GLSL3,
  Mesh,
  NearestFilter,
  OrthographicCamera,
  RawShaderMaterial,
  Sphere,
  Vector2,
  Vector3,
  Vector4,
  WebGLRenderTarget,
  type Camera,
  type Scene,
  type WebGLRenderer,
} from "three";

const vertexShader = `
in vec2 position;
out vec2 place;
void main() {
  place = 0.5 * position + 0.5;
  gl_Position = vec4(position, 0.0, 1.0);
}`;

const samples = 12;

/** Evenly over the unit disc: a sunflower's seeds. */
function sunflower(): string {
  const seeds = Array.from({ length: samples }, (_, i) => {
    const radius = Math.sqrt((i + 1) / samples);
    const angle = i * Math.PI * (3 - Math.sqrt(5));
    return `vec2(${(radius * Math.cos(angle)).toFixed(6)}, ${(radius * Math.sin(angle)).toFixed(6)})`;
  });
  return `const vec2 around[${samples}] = vec2[${samples}](${seeds.join(", ")});`;
}

const fragmentShader = `
precision highp float;
uniform sampler2D picture;   // alpha: how much of the light counts
uniform sampler2D depths;
uniform vec2 pixel;          // in shares of the screen
uniform float pixelRatio;
uniform vec4 depthRows;      // of the projection: how depths in the buffer follow from depths in space
uniform float pixelSize;     // in space: of a pixel at depth 1 (perspective) or anywhere
uniform bool isPerspective;
uniform float splatRadius;
uniform vec3 background;
in vec2 place;
out vec4 result;

const float nowhere = 1e6;
${sunflower()}
const vec3 lamp = vec3(-0.38, 0.52, 0.765);

// In front of the viewer; far behind everything where there is nothing.
float depthAt(vec2 at) {
  float d = texture(depths, at).r;
  float ndc = 2.0 * d - 1.0;
  return d >= 1.0 ? nowhere : (depthRows.z - ndc * depthRows.w) / (depthRows.x - ndc * depthRows.y);
}

void main() {
  float depth = depthAt(place);
  if (depth == nowhere) {
    result = vec4(background, 1.0);
    return;
  }
  float size = pixelSize * (isPerspective ? depth : 1.0);
  float reach = clamp(1.5 * splatRadius / size, 2.5 * pixelRatio, 14.0 * pixelRatio);

  // The plane that fits what is around best, all lengths in pixels. What is far in front or behind is another
  // surface.
  float count = 1.0, hidden = 0.0;
  vec2 sum = vec2(0.0), rises = vec2(0.0);
  vec3 squares = vec3(0.0);
  float height = 0.0;
  float steepest = 4.0 * reach;
  for (int i = 0; i < ${samples}; ++i) {
    vec2 offset = reach * around[i];
    float rise = (depth - depthAt(place + offset * pixel)) / size;
    if (abs(rise) > steepest) {
      hidden += rise > 0.0 ? 1.0 : 0.25;
      continue;
    }
    count += 1.0;
    sum += offset;
    height += rise;
    rises += rise * offset;
    squares += vec3(offset.x * offset.x, offset.x * offset.y, offset.y * offset.y);
  }
  squares -= vec3(sum.x * sum.x, sum.x * sum.y, sum.y * sum.y) / count;
  rises -= height * sum / count;
  float determinant = squares.x * squares.z - squares.y * squares.y;
  vec2 slope = vec2(squares.z * rises.x - squares.y * rises.y, squares.x * rises.y - squares.y * rises.x);
  slope = determinant > 1e-3 ? slope / determinant : vec2(0.0);

  float light = 0.52 + 0.52 * max(0.0, dot(normalize(vec3(-slope, 1.0)), lamp));
  // Behind silhouettes and in crevices it is darker.
  light *= exp(-0.07 * hidden) * exp(-0.25 * clamp(height / count / reach, 0.0, 2.0));
  vec4 seen = texture(picture, place);
  result = vec4(seen.rgb * mix(1.0, light, seen.a), 1.0);
}`;

/**
 * Light for points without normals: the surface at a pixel is the plane that fits the depths around it, and what lies
 * behind an edge of the depths is darker, as in eye-dome lighting (C. Boucheny 2009).
 */
export class EyeDome {
  private readonly target: WebGLRenderTarget;
  private readonly sheet: Mesh<BufferGeometry, RawShaderMaterial>;
  private readonly camera = new OrthographicCamera();

  constructor() {
    this.target = new WebGLRenderTarget(1, 1, {
      minFilter: NearestFilter,
      magFilter: NearestFilter,
      depthTexture: new DepthTexture(1, 1, FloatType),
    });
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.of(-1, -1, 3, -1, -1, 3), 2));
    geometry.boundingSphere = new Sphere();
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      depthTest: false,
      depthWrite: false,
      uniforms: {
        picture: { value: this.target.texture },
        depths: { value: this.target.depthTexture },
        pixel: { value: new Vector2() },
        pixelRatio: { value: 1 },
        depthRows: { value: new Vector4() },
        splatRadius: { value: 0 },
        pixelSize: { value: 1 },
        isPerspective: { value: true },
        background: { value: new Vector3() },
      },
    });
    this.sheet = new Mesh(geometry, material);
    this.sheet.frustumCulled = false;
  }

  render(
    renderer: WebGLRenderer,
    scene: Scene,
    camera: Camera,
    splatRadius: number,
    background: Color,
  ): void {
    const size = renderer.getDrawingBufferSize(new Vector2());
    this.target.setSize(size.x, size.y);
    const u = this.sheet.material.uniforms;
    const p = camera.projectionMatrix.elements;
    u.pixel.value.set(1 / size.x, 1 / size.y);
    u.pixelRatio.value = renderer.getPixelRatio();
    // z_ndc = (p10 z + p14) / (p11 z + p15) with z = -depth.
    u.depthRows.value.set(p[10], p[11], p[14], p[15]);
    u.splatRadius.value = splatRadius;
    u.pixelSize.value = 2 / (p[5] * size.y);
    u.isPerspective.value = p[11] !== 0;
    u.background.value.set(background.r, background.g, background.b);

    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0x000000, 1);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.sheet, this.camera);
  }
}
