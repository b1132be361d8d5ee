// SPDX-License-Identifier: MIT
// Paints robots with WebGL, with one instance of a quad per robot. The shader computes shapes and colours. Each
// frame sends four numbers per robot to the graphics card.

import { shapes } from "../palette.json";
import type { Camera } from "./camera";
import type { Colors } from "./colors";
import type { World } from "./model";
import type { RobotPainter } from "./robots";
import type { RobotsNow } from "./robots_now";

const kNumbers = 4; // per robot: x, y, angle, Doing or kColliding (+ kTurns if it has a heading)
const kColliding = 4;
const kTurns = 8;

const kVertexShader = `#version 300 es
uniform vec2 center;   // of the view, in the world's units
uniform vec2 halfView; // of the view, in pixels
uniform float scale;   // pixels for a unit
uniform float radius;  // of a robot, in pixels
in vec2 corner;        // of the quad, -1 to 1
in vec4 robot;
out vec2 at;           // in radii
flat out vec2 ahead;
flat out int doing;
flat out int turns;
void main() {
  int what = int(robot.w + 0.5);
  turns = what / ${kTurns};
  doing = what % ${kTurns};
  ahead = vec2(sin(robot.z), -cos(robot.z));
  at = corner * 1.5;
  vec2 pixel = (robot.xy - center) * scale + at * radius;
  gl_Position = vec4(pixel / halfView * vec2(1, -1), 0, 1);
}`;

const kFragmentShader = `#version 300 es
precision highp float;
uniform float radius;
uniform vec3 colors[5];
uniform vec3 headingColor;
const float headingBase = float(${shapes.headingBase});
const float headingTip = float(${shapes.headingTip});
in vec2 at;
flat in vec2 ahead;
flat in int doing;
flat in int turns;
out vec4 color;
// Fraction of this pixel that a shape covers.
float cover(float distance) { return clamp(0.5 - distance * radius, 0.0, 1.0); }
void main() {
  float away = length(at);
  float edge = doing == 4 ? mix(0.95, 1.4, 0.5 + 0.5 * cos(8.0 * atan(at.y, at.x))) : 1.0;
  float body = cover(away - edge);
  vec3 paint = colors[doing];
  float alpha = body;
  if (turns == 1 && radius > 3.0) {
    float along = dot(at, ahead);
    float across = abs(dot(at, vec2(-ahead.y, ahead.x)));
    float wedge = cover(max(headingBase - along, across - (headingTip - along)));
    paint = mix(paint, headingColor, wedge);
    alpha = max(alpha, wedge);
  }
  color = vec4(paint * alpha, alpha);
}`;

export class GlRobots implements RobotPainter {
  private readonly numbers: Float32Array;
  private readonly buffer: WebGLBuffer;
  private readonly uniforms: Record<string, WebGLUniformLocation | null> = {};

  private constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly world: World,
    count: number,
  ) {
    this.numbers = new Float32Array(kNumbers * count);
    const program = link(gl);
    gl.useProgram(program);
    for (const name of ["center", "halfView", "scale", "radius", "colors", "headingColor"])
      this.uniforms[name] = gl.getUniformLocation(program, name);
    attribute(gl, program, "corner", 2, 0, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
    this.buffer = attribute(gl, program, "robot", kNumbers, 1, this.numbers);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  // Returns null if the browser does not support WebGL 2.
  static on(canvas: HTMLCanvasElement, world: World, count: number): GlRobots | null {
    const gl = canvas.getContext("webgl2");
    return gl ? new GlRobots(gl, world, count) : null;
  }

  // Whether WebGL runs on a graphics card; in software it is slower than a 2D canvas. Tests this on a new
  // canvas, so that the canvases of the page remain unchanged.
  static isFast(): boolean {
    const gl = document.createElement("canvas").getContext("webgl2", {
      failIfMajorPerformanceCaveat: true,
    });
    const names = gl?.getExtension("WEBGL_debug_renderer_info");
    if (!gl || !names) return gl !== null;
    const name = String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
    return !/swiftshader|llvmpipe|software|basic render/i.test(name);
  }

  paint(camera: Camera, frame: RobotsNow, colors: Colors, ratio: number): void {
    const { gl, uniforms } = this;
    const count = this.gather(frame);
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, this.numbers, gl.DYNAMIC_DRAW);
    const scale = camera.scale * ratio;
    gl.uniform2f(uniforms.center, camera.center.x, camera.center.y);
    gl.uniform2f(uniforms.halfView, (camera.width * ratio) / 2, (camera.height * ratio) / 2);
    gl.uniform1f(uniforms.scale, scale);
    gl.uniform1f(uniforms.radius, Math.max(1.5 * ratio, shapes.robotRadius * this.world.unit * scale));
    gl.uniform3fv(uniforms.colors, [...colors.doing, colors.collision].flatMap(rgb));
    gl.uniform3fv(uniforms.headingColor, rgb(colors.heading));
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
  }

  // Fills `numbers`. Puts colliding robots last, so that no other robot hides them. Returns the number of
  // robots.
  private gather(frame: RobotsNow): number {
    let at = 0;
    for (let pass = 0; pass < 2; ++pass)
      for (let i = 0; i < frame.count; ++i) {
        if (frame.missing[i] || frame.colliding[i] !== pass) continue;
        const turns = !Number.isNaN(frame.angles[i]);
        this.numbers[at] = frame.xs[i];
        this.numbers[at + 1] = frame.ys[i];
        this.numbers[at + 2] = turns ? frame.angles[i] : 0;
        this.numbers[at + 3] = (pass === 1 ? kColliding : frame.doing[i]) + (turns ? kTurns : 0);
        at += kNumbers;
      }
    return at / kNumbers;
  }
}

function rgb(color: string): number[] {
  const value = parseInt(color.slice(1), 16);
  return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}

function link(gl: WebGL2RenderingContext): WebGLProgram {
  const program = gl.createProgram()!;
  const shaders = [
    [gl.VERTEX_SHADER, kVertexShader], [gl.FRAGMENT_SHADER, kFragmentShader],
  ] as const;
  for (const [kind, source] of shaders) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS))
    throw new Error(`WebGL: ${gl.getProgramInfoLog(program) ?? "no program"}`);
  return program;
}

// Binds `values` to a shader attribute. `divisor`: 0: one value per vertex; 1: one value per instance.
function attribute(
  gl: WebGL2RenderingContext, program: WebGLProgram, name: string, size: number, divisor: number,
  values: Float32Array,
): WebGLBuffer {
  const buffer = gl.createBuffer()!;
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, values, divisor === 0 ? gl.STATIC_DRAW : gl.DYNAMIC_DRAW);
  const place = gl.getAttribLocation(program, name);
  gl.enableVertexAttribArray(place);
  gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
  gl.vertexAttribDivisor(place, divisor);
  return buffer;
}
