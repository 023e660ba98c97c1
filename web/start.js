// Loads main.js, which is a module, or the bundle for a page that was opened from disk.
const script = document.createElement('script');
if (location.protocol === 'file:') script.src = 'disk.js';
else Object.assign(script, { type: 'module', src: 'main.js' });
document.body.append(script);
