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
  Vector2,
  Vector3,
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

const fragmentShader = `
precision highp float;
uniform sampler2D picture;
uniform sampler2D depths;
uniform vec2 pixel;          // in shares of the screen
uniform float pixelRatio;
uniform vec2 depthRow;       // of the projection: how depths in the buffer follow from depths in space
uniform vec2 depthRow2;
uniform float pixelSize;     // of a pixel at depth 1 (perspective) or anywhere, in space
uniform bool isPerspective;
uniform vec3 background;
in vec2 place;
out vec4 result;

// In front of the viewer; far behind everything where there is nothing.
float depthAt(vec2 at) {
  float d = texture(depths, at).r;
  if (d >= 1.0) return 1e6;
  float ndc = 2.0 * d - 1.0;
  return (depthRow2.x - ndc * depthRow2.y) / (depthRow.x - ndc * depthRow.y);
}

void main() {
  float center = depthAt(place);
  // How steeply everything around stands before the pixel: crevices and silhouettes are dark.
  float scale = pixelSize * (isPerspective ? min(center, 1e3) : 1.0);
  float shade = 0.0;
  for (int i = 0; i < 8; ++i) {
    float angle = 0.785398 * float(i);
    vec2 offset = vec2(cos(angle), sin(angle)) * pixelRatio * (i % 2 == 0 ? 1.2 : 2.4);
    float rise = (min(center, 1e5) - depthAt(place + offset * pixel)) / (scale * length(offset));
    shade += clamp(rise, 0.0, 4.0);
  }
  float light = exp(-0.055 * shade);
  vec4 seen = texture(picture, place);
  bool isBackground = center > 1e5;
  result = vec4(isBackground ? mix(background, background * light, 0.35) : seen.rgb * light, 1.0);
}`;

/**
 * Eye-dome lighting (C. Boucheny 2009): shape from depth alone, for points without normals.
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
        depthRow: { value: new Vector2() },
        depthRow2: { value: new Vector2() },
        pixelSize: { value: 1 },
        isPerspective: { value: true },
        background: { value: new Vector3() },
      },
    });
    this.sheet = new Mesh(geometry, material);
    this.sheet.frustumCulled = false;
  }

  render(renderer: WebGLRenderer, scene: Scene, camera: Camera, background: Color): void {
    const size = renderer.getDrawingBufferSize(new Vector2());
    this.target.setSize(size.x, size.y);
    const u = this.sheet.material.uniforms;
    const p = camera.projectionMatrix.elements;
    u.pixel.value.set(1 / size.x, 1 / size.y);
    u.pixelRatio.value = renderer.getPixelRatio();
    // z_ndc = (p10 z + p14) / (p11 z + p15) with z = -depth.
    u.depthRow.value.set(p[10], p[11]);
    u.depthRow2.value.set(p[14], p[15]);
    u.pixelSize.value = 2 / (p[5] * size.y);
    u.isPerspective.value = p[11] !== 0;
    u.background.value.set(background.r, background.g, background.b);

    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.sheet, this.camera);
  }
}
