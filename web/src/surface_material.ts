import * as THREE from 'three';

const INSIDE = new THREE.Color(0x7a4a3f);

/** The lights stand beside the eye: directions in the frame of the camera, y up, z to the eye. */
const LIGHT = /* glsl */ `
vec3 lit(vec3 normal) {
  vec3 light = mix(vec3(0.068, 0.060, 0.051), vec3(0.824, 0.879, 1.0), 0.5 * normal.y + 0.5) * 0.30;
  light += vec3(1.0, 0.922, 0.823) * 0.86 * max(dot(normal, vec3(-0.487, 0.584, 0.649)), 0.0);
  light += vec3(0.624, 0.776, 1.0) * 0.24 * max(dot(normal, vec3(0.966, -0.097, 0.241)), 0.0);
  return light + 0.28 * max(dot(normal, vec3(0.249, 0.498, -0.831)), 0.0);
}
float gloss(vec3 normal, vec3 eye) {
  return 0.085 * pow(max(dot(normal, normalize(vec3(-0.487, 0.584, 0.649) + eye)), 0.0), 14.0);
}`;

const VERTEX = /* glsl */ `
varying vec3 vLightOut, vLightIn;
varying vec3 vAt;
#ifdef COLORED
attribute vec3 color;
varying vec3 vOwnColor;
#endif
${LIGHT}
#include <clipping_planes_pars_vertex>
void main() {
  vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * mvPosition;
  vAt = mvPosition.xyz;
  #ifndef FLAT
  vec3 normalInView = normalize(normalMatrix * normal);
  vec3 eye = normalize(-mvPosition.xyz);
  vLightOut = lit(normalInView) + gloss(normalInView, eye);
  vLightIn = lit(-normalInView);
  #endif
  #ifdef COLORED
  vOwnColor = color;
  #endif
  #include <clipping_planes_vertex>
}`;

const FRAGMENT = /* glsl */ `
uniform vec3 plain, inside;
varying vec3 vLightOut, vLightIn;
varying vec3 vAt;
#ifdef COLORED
varying vec3 vOwnColor;
#endif
${LIGHT}
#include <clipping_planes_pars_fragment>
void main() {
  #include <clipping_planes_fragment>
  vec3 base = plain;
  #ifdef COLORED
  base = vOwnColor;
  #endif
  if (!gl_FrontFacing) base = inside;
  #ifdef FLAT
  vec3 facing = normalize(cross(dFdx(vAt), dFdy(vAt)));
  gl_FragColor = vec4(base * (lit(facing) + gloss(facing, normalize(-vAt))), 1.0);
  #else
  gl_FragColor = vec4(base * (gl_FrontFacing ? vLightOut : vLightIn), 1.0);
  #endif
  #include <colorspace_fragment>
}`;

/**
 * Gouraud shading: light is computed at the vertices, whose normals are those of the measured surface. Without a graphics
 * card this takes half the time of a physically based material; both sides are drawn at once.
 */
export class SurfaceMaterial extends THREE.ShaderMaterial {
  constructor(color: number, bothSides = false) {
    const plain = new THREE.Color(color);
    super({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { plain: { value: plain }, inside: { value: bothSides ? plain : INSIDE } },
      side: THREE.DoubleSide,
      clipping: true,
    });
  }
  private define(name: string, wanted: boolean): void {
    const defines = this.defines as Record<string, unknown>;
    if (name in defines === wanted) return;
    if (wanted) defines[name] = '';
    else delete defines[name];
    this.needsUpdate = true;
  }
  /** One normal for each triangle. */
  setFlat(flat: boolean): void {
    this.define('FLAT', flat);
  }
  /** Colours of the vertices instead of the plain one. */
  setColored(colored: boolean): void {
    this.define('COLORED', colored);
  }
}
