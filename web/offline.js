// Caches the page in the browser, so that it works without a network. build.mjs fills in the version and the files.
const kCache = 'cotan-/* version */';
const kFiles = [/* files */];

self.addEventListener('install', event => event.waitUntil(caches.open(kCache).then(cache => cache.addAll(kFiles)).then(() => self.skipWaiting())));
self.addEventListener('activate', event => event.waitUntil(caches.keys().then(names =>
  Promise.all(names.filter(name => name.startsWith('cotan-') && name !== kCache).map(name => caches.delete(name)))).then(() => self.clients.claim())));
self.addEventListener('fetch', event => event.respondWith(caches.match(event.request, { ignoreSearch: true }).then(kept => kept ?? fetch(event.request))));
