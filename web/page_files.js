// Files of the page that its scripts load. web/build.mjs replaces this by page_files_inside.js in the bundle for a page
// that was opened from disk, where a browser loads no modules and fetches no files.
export const fileAddress = name => new URL(name, self.document?.baseURI ?? self.location.href).href;
export const startWorker = () => new Worker(fileAddress('worker.js'), { type: 'module' });
