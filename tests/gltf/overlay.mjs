// Reads a case that was exported in all formats with readers that others wrote, and checks that all files
// hold the same jaws in the same place.
//     node overlay.mjs NAME.glb NAME-upper.stl NAME-upper.ply NAME-upper.obj NAME-lower.stl ...
// three.js compares every corner of every triangle; Open Asset Import Library, where its command is
// installed, the counts and the extent.
import { execFileSync } from "node:child_process";
import { readFile } from "node:fs/promises";
import path from "node:path";
import process from "node:process";

const kSkipped = 77;
const kLargestOffsetMm = 0.001;
const kNameOfStage = /-(upper|lower|bite)\.(stl|ply|obj)$/;

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(kSkipped);
}

// GLTFLoader asks a browser for the texture. Here there is none, and positions do without.
globalThis.self = globalThis;
console.error = () => {};

const load = (name) => import(name).catch(() => skip("three.js is not installed; ./run test installs it"));
const THREE = await load("three");
const { GLTFLoader } = await load("three/addons/loaders/GLTFLoader.js");
const { STLLoader } = await load("three/addons/loaders/STLLoader.js");
const { PLYLoader } = await load("three/addons/loaders/PLYLoader.js");
const { OBJLoader } = await load("three/addons/loaders/OBJLoader.js");

async function bytes_of(file) {
  const bytes = await readFile(file);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
}

// The corners of all triangles below a node, three after the other, where the node places them.
function corners_of(root) {
  const corners = [];
  root.updateMatrixWorld(true);
  root.traverse((node) => {
    if (!node.isMesh) return;
    const geometry = node.geometry.index ? node.geometry.toNonIndexed() : node.geometry;
    const positions = geometry.getAttribute("position");
    for (let i = 0; i < positions.count; ++i) {
      corners.push(new THREE.Vector3().fromBufferAttribute(positions, i).applyMatrix4(node.matrixWorld));
    }
  });
  return corners;
}

async function corners_of_file(file) {
  const bytes = await bytes_of(file);
  switch (path.extname(file)) {
    case ".stl": return corners_of(new THREE.Mesh(new STLLoader().parse(bytes)));
    case ".ply": return corners_of(new THREE.Mesh(new PLYLoader().parse(bytes)));
    default: return corners_of(new OBJLoader().parse(new TextDecoder().decode(bytes)));
  }
}

// docs/formats.md: (x, y, z) mm are (x, z, -y) / 1000 m in the .glb.
const to_patient_mm = (p) => new THREE.Vector3(1000 * p.x, -1000 * p.z, 1000 * p.y);

// The largest distance of a point to the nearest of the others.
function largest_offset_mm(points, others) {
  const key = (x, y, z) => `${x},${y},${z}`;
  const cell = (value) => Math.floor(value / (2 * kLargestOffsetMm));
  const grid = new Map();
  for (const p of others) {
    const at = key(cell(p.x), cell(p.y), cell(p.z));
    if (!grid.has(at)) grid.set(at, []);
    grid.get(at).push(p);
  }
  let largest = 0;
  for (const p of points) {
    let nearest = Infinity;
    for (let x = -1; x <= 1; ++x) for (let y = -1; y <= 1; ++y) for (let z = -1; z <= 1; ++z) {
      for (const other of grid.get(key(cell(p.x) + x, cell(p.y) + y, cell(p.z) + z)) ?? []) {
        nearest = Math.min(nearest, p.distanceTo(other));
      }
    }
    largest = Math.max(largest, nearest);
  }
  return largest;
}

function extent_by_assimp(file) {
  const text = execFileSync("assimp", ["info", file], { encoding: "utf8" });
  const numbers = (label) => text.match(new RegExp(`${label}\\s+\\(?([-0-9. ]+)`))[1].trim().split(/\s+/).map(Number);
  return { faces: numbers("Faces:")[0], least: numbers("Minimum point"), most: numbers("Maximum point") };
}

let failures = 0;
function check(what, is_good, seen) {
  console.log(`${is_good ? "ok" : "FAILED"}: ${what}: ${seen}`);
  failures += is_good ? 0 : 1;
}

function check_by_assimp(glb, files, faces_of_file) {
  const is_there = () => {
    try { execFileSync("assimp", ["version"]); return true; } catch { return false; }
  };
  if (!is_there()) {
    console.log("not checked with assimp: it is not installed; ./run test installs it");
    return;
  }
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  let faces = 0;
  for (const file of files) {
    const extent = extent_by_assimp(file);
    check(`${file}: triangles (assimp)`, extent.faces === faces_of_file.get(file), extent.faces);
    if (path.extname(file) !== ".stl") continue;
    faces += extent.faces;
    extent.least.forEach((value, i) => { least[i] = Math.min(least[i], value); });
    extent.most.forEach((value, i) => { most[i] = Math.max(most[i], value); });
  }
  const whole = extent_by_assimp(glb);
  check(`${glb}: triangles (assimp)`, whole.faces === faces, whole.faces);
  // It prints meters with six digits: 1 µm, and half of it by rounding.
  const wanted = [least[0], least[2], -most[1], most[0], most[2], -least[1]].map((mm) => mm / 1000);
  const offset = Math.max(...[...whole.least, ...whole.most].map((m, i) => Math.abs(m - wanted[i])));
  check(`${glb}: extent (assimp)`, offset < 1.6e-6, `${(1e6 * offset).toFixed(2)} µm off`);
}

const [glb, ...files] = process.argv.slice(2);
const { scene } = await new GLTFLoader().parseAsync(await bytes_of(glb), "");
const faces_of_file = new Map();
for (const file of files) {
  const stage = file.match(kNameOfStage)[1];
  const node = scene.getObjectByName(stage);
  check(`${glb}: node ${stage}`, node !== undefined, node?.name);
  if (!node) continue;
  const expected = corners_of(node).map(to_patient_mm), found = await corners_of_file(file);
  faces_of_file.set(file, found.length / 3);
  check(`${file}: triangles`, found.length === expected.length && found.length > 0, found.length / 3);
  const offset = Math.max(largest_offset_mm(found, expected), largest_offset_mm(expected, found));
  check(`${file}: offset from the .glb`, offset <= kLargestOffsetMm, `${(1000 * offset).toFixed(4)} µm`);
}
check_by_assimp(glb, files, faces_of_file);
process.exit(failures > 0 ? 1 : 0);
