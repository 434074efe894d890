/** The stage: lights, camera, and the views from which to look at the model. */

import {
  NeutralToneMapping,
  Color,
  DirectionalLight,
  HemisphereLight,
  Mesh,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { distance, framing, type Framing } from "./framing.ts";
import type { Model } from "./model.ts";
import { VIEWS, type View } from "./views.ts";

const FIELD_OF_VIEW = 22;
const GLIDE = 260;

export class Stage {
  #renderer: WebGLRenderer;
  #scene = new Scene();
  #camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
  #orbit: OrbitControls;
  #framing: Framing;
  #view: string | null = "three-quarter";
  #glide: { from: Vector3; to: Vector3; target: [Vector3, Vector3]; since: number } | null = null;
  #listeners: (() => void)[] = [];
  #turned: (() => void)[] = [];

  /** A `plain` stage has neither shadows nor smooth edges: for processors without a graphics card. */
  constructor(canvas: HTMLCanvasElement, model: Model, used: string[], plain = false) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: !plain, alpha: true });
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.toneMapping = NeutralToneMapping;
    this.#renderer.toneMappingExposure = 1.12;
    this.#renderer.shadowMap.enabled = !plain;
    this.#renderer.shadowMap.type = PCFShadowMap;
    this.#framing = framing(model.root, model.meshes, used, model.turned(used));
    this.#scene.add(model.root);
    model.root.traverse((object) => {
      object.castShadow = object.receiveShadow = object instanceof Mesh;
    });
    this.#light();
    this.#orbit = new OrbitControls(this.#camera, canvas);
    this.#orbit.enableDamping = false;
    this.#orbit.addEventListener("start", () => {
      this.#glide = null;
      this.#view = null;
      this.#announce();
    });
    this.#orbit.addEventListener("change", () => {
      this.#announce();
      for (const listener of this.#turned) listener();
    });
  }

  /** Call `listener` when a new picture is needed or the view has changed. */
  onChange(listener: () => void): void {
    this.#listeners.push(listener);
  }

  /** Call `listener` when the camera has moved. */
  onTurn(listener: () => void): void {
    this.#turned.push(listener);
  }

  /** Look from where another stage looks. */
  lookAs(other: Stage): void {
    this.#glide = null;
    this.#view = other.#view;
    this.#look(other.#camera.position.clone(), other.#orbit.target.clone());
  }

  /** Give up the picture: another stage may draw on the same canvas. */
  dispose(): void {
    this.#orbit.dispose();
    this.#renderer.dispose();
  }

  /** The name of the view, or null once the user has turned the model. */
  get view(): string | null {
    return this.#view;
  }

  setView(name: string, gliding = false): void {
    if (!(name in VIEWS)) throw new RangeError(`no view "${name}"`);
    this.#view = name;
    const [place, target] = this.#placeOf(VIEWS[name]);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (gliding && !still) {
      const from = this.#camera.position.clone();
      const pair: [Vector3, Vector3] = [this.#orbit.target.clone(), target];
      this.#glide = { from, to: place, target: pair, since: performance.now() };
    } else {
      this.#glide = null;
      this.#look(place, target);
    }
    this.#announce();
  }

  /** Turn the camera about what it looks at, in degrees, and move it by a factor. */
  turn(azimuth: number, elevation: number, nearer = 1): void {
    const offset = this.#camera.position.clone().sub(this.#orbit.target).multiplyScalar(nearer);
    offset.applyAxisAngle(new Vector3(0, 1, 0), (azimuth * Math.PI) / 180);
    const right = new Vector3(offset.z, 0, -offset.x).normalize();
    const lifted = offset.clone().applyAxisAngle(right, (-elevation * Math.PI) / 180);
    const steep = Math.abs(lifted.y) > 0.98 * lifted.length();
    this.#view = null;
    this.#glide = null;
    this.#look((steep ? offset : lifted).add(this.#orbit.target), this.#orbit.target);
    this.#announce();
  }

  resize(width: number, height: number): void {
    this.#renderer.setSize(width, height, false);
    this.#camera.aspect = width / height;
    this.#camera.updateProjectionMatrix();
    if (this.#view) this.setView(this.#view);
    this.#announce();
  }

  /** Draw; returns whether the camera is still on its way. */
  draw(): boolean {
    if (this.#glide) {
      const { from, to, target, since } = this.#glide;
      const share = Math.min((performance.now() - since) / GLIDE, 1);
      const eased = 1 - (1 - share) ** 3;
      this.#look(from.clone().lerp(to, eased), target[0].clone().lerp(target[1], eased));
      if (share === 1) this.#glide = null;
    }
    this.#renderer.render(this.#scene, this.#camera);
    return this.#glide !== null;
  }

  #placeOf(view: View): [Vector3, Vector3] {
    const frame = this.#framing[view.part];
    const far = distance(this.#framing.head, FIELD_OF_VIEW, this.#camera.aspect);
    const near = distance(frame, FIELD_OF_VIEW, this.#camera.aspect);
    const azimuth = (view.azimuth * Math.PI) / 180;
    const elevation = (view.elevation * Math.PI) / 180;
    const direction = new Vector3(
      Math.sin(azimuth) * Math.cos(elevation),
      Math.sin(elevation),
      Math.cos(azimuth) * Math.cos(elevation),
    );
    this.#camera.near = near / 50;
    this.#camera.far = far * 20;
    this.#camera.updateProjectionMatrix();
    return [direction.multiplyScalar(near).add(frame.centre), frame.centre.clone()];
  }

  #look(place: Vector3, target: Vector3): void {
    this.#camera.position.copy(place);
    this.#orbit.target.copy(target);
    this.#camera.lookAt(target);
    this.#orbit.update();
  }

  #light(): void {
    this.#scene.add(new HemisphereLight(0xe3e9f2, 0xa08676, 1));
    this.#lamp(0xf6f1f4, 0.65, [-0.7, -0.4, 1.3]);
    const key = this.#lamp(0xfff0e0, 1.9, [0.8, 0.9, 1.4]);
    const rim = this.#lamp(0xdbe7ff, 1.3, [-1.3, 0.3, -1]);
    this.#castShadow(key, 1024);
    this.#castShadow(rim, 1024);
    // Light that the skin throws back reaches what lies in the shadow of the first.
    key.shadow.intensity = 0.75;
  }

  #castShadow(lamp: DirectionalLight, size: number): void {
    const { halfHeight, halfWidth } = this.#framing.head;
    const reach = 1.25 * Math.max(halfHeight, halfWidth);
    const { camera } = lamp.shadow;
    camera.left = camera.bottom = -reach;
    camera.right = camera.top = reach;
    camera.near = reach;
    camera.far = 7 * reach;
    lamp.castShadow = true;
    lamp.shadow.mapSize.set(size, size);
    lamp.shadow.radius = 4;
    lamp.shadow.normalBias = reach * 0.014;
    lamp.shadow.bias = -0.001;
  }

  #lamp(colour: number, strength: number, from: [number, number, number]): DirectionalLight {
    const { centre, halfHeight, halfWidth } = this.#framing.head;
    const lamp = new DirectionalLight(new Color(colour), strength);
    const way = new Vector3(...from).setLength(4 * Math.max(halfHeight, halfWidth));
    lamp.position.copy(centre).add(way);
    lamp.target.position.copy(centre);
    this.#scene.add(lamp, lamp.target);
    return lamp;
  }

  #announce(): void {
    for (const listener of this.#listeners) listener();
  }
}
