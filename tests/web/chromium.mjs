// Headless Chromium on SwiftShader, and a web server for folders.
import { createServer } from 'node:http';
import { existsSync, readFileSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { extname, join } from 'node:path';

const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.png': 'image/png', '.svg': 'image/svg+xml' };

// folders: keys are the first component of a path. Returns the server's address, and a function that stops it.
export async function serve(folders) {
  const server = createServer((request, response) => {
    const [, first, ...rest] = decodeURIComponent(request.url.split('?')[0]).split('/');
    const file = join(folders[first] ?? '/nowhere', ...rest);
    if (!existsSync(file) || !statSync(file).isFile()) { response.writeHead(404).end(); return; }
    response.writeHead(200, { 'content-type': kTypes[extname(file)] ?? 'application/octet-stream' }).end(readFileSync(file));
  }).listen(0, '127.0.0.1');
  await new Promise(done => server.once('listening', done));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

// Options with which Chromium has WebGPU, whose canvas needs textures that both processes share: therefore those of Vulkan.
export const kGpuArguments = ['--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--enable-features=Vulkan', '--use-vulkan=swiftshader', '--disable-vulkan-surface'];

export async function launch(modules, more = []) {
  const { chromium } = createRequire(join(modules, 'x.js'))('playwright-core');
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', ...more],
  });
}
