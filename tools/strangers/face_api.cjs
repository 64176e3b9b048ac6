// One judge: the expression network of the npm package @vladmandic/face-api, which finds and aligns faces itself.
//
//     node tools/strangers/face_api.cjs FOLDER [--points] < pictures.json
//
// FOLDER has node_modules. Reads a list of picture files and writes {file: {class: probability} or null}, null where
// no face was found; with --points its 68 landmarks instead, [[x, y], ...] in pixels. Trained on photographs by its authors (SSD MobileNet, 68 landmarks, depthwise CNN); WebAssembly, so
// that nothing is compiled and nothing fetched.
'use strict';

const fs = require('fs');
const path = require('path');
const { createRequire } = require('module');

const from = createRequire(path.join(path.resolve(process.argv[2]), 'node_modules', '_'));
const { PNG } = from('pngjs');
const tf = from('@tensorflow/tfjs');
const wasm = from('@tensorflow/tfjs-backend-wasm');
const faceapi = from('@vladmandic/face-api/dist/face-api.node-wasm.js');

const NAMES = {
  neutral: 'neutral', happy: 'joy', sad: 'sadness', angry: 'anger',
  fearful: 'fear', disgusted: 'disgust', surprised: 'surprise',
};

function pixels(file) {
  const { width, height, data } = PNG.sync.read(fs.readFileSync(file));
  const rgb = new Int32Array(width * height * 3);
  for (let i = 0; i < width * height; i += 1) rgb.set(data.subarray(4 * i, 4 * i + 3), 3 * i);
  return tf.tensor3d(rgb, [height, width, 3], 'int32');
}

async function main() {
  const binary = from.resolve('@tensorflow/tfjs-backend-wasm/dist/tfjs-backend-wasm.wasm');
  wasm.setWasmPaths(path.dirname(binary) + path.sep);
  await tf.setBackend('wasm');
  await tf.ready();
  const weights = path.join(path.dirname(from.resolve('@vladmandic/face-api/package.json')), 'model');
  const { ssdMobilenetv1, faceLandmark68Net, faceExpressionNet } = faceapi.nets;
  for (const net of [ssdMobilenetv1, faceLandmark68Net, faceExpressionNet]) await net.loadFromDisk(weights);
  const options = new faceapi.SsdMobilenetv1Options({ minConfidence: 0.1 }); // as in the package's own example for Node
  const said = {};
  for (const file of JSON.parse(fs.readFileSync(0, 'utf8'))) {
    const picture = pixels(file);
    const face = await faceapi.detectSingleFace(picture, options).withFaceLandmarks().withFaceExpressions();
    picture.dispose();
    said[file] = face && (process.argv.includes('--points')
      ? face.landmarks.positions.map((point) => [point.x, point.y])
      : Object.fromEntries(Object.entries(NAMES).map(([name, ours]) => [ours, face.expressions[name]])));
    if (said[file] === undefined) said[file] = null;
  }
  process.stdout.write(JSON.stringify(said));
}

main().catch((error) => { console.error(error); process.exit(1); });
