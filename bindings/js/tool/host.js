// Part of the generated wasm/cli.cjs: gives the tool the files, streams and variables of Node.js. Emscripten's own layer
// (NODERAWFS) takes every stream for a terminal, cuts long names, and knows no drives.
Module['preRun'] = () => {
  const os = require('os'), tty = require('tty'), { parentPort, workerData } = require('worker_threads');
  const pause = new Int32Array(new SharedArrayBuffer(4));
  Object.assign(ENV, process.env);

  const windows = process.platform === 'win32', names = namesOfFiles(require('path')), { inside, outside } = names;
  const failed = (error) => ERRNO_CODES[error.code] ?? ERRNO_CODES.EIO;
  const wrapped = (work) => (...words) => {
    try {
      return work(...words.map(outside));
    } catch (error) {
      throw typeof error.code === 'string' ? new FS.ErrnoError(failed(error)) : error;
    }
  };
  for (const name of Object.keys(NODERAWFS)) FS[name] = wrapped(NODERAWFS[name]);

  // Waits where a pipe or a terminal that another program has opened is full, or empty, for now.
  const patient = (work) => {
    for (;;)
      try {
        return work();
      } catch (error) {
        if (error.code !== 'EAGAIN' && error.code !== 'EINTR') throw error;
        Atomics.wait(pause, 0, 0, 2);
      }
  };
  // Unfinished files have a name of their own (files/output.cpp). cli.mjs removes those that it knows if a signal comes.
  const note = (name) => { if (parentPort && /(^|[/\\])\.cotan-[^/\\]*\.part[^/\\]*$/.test(name)) parentPort.postMessage(nodePath.resolve(name)); };

  FS.createStandardStreams = () => {
    for (const fd of [0, 1, 2])
      FS.streams[fd] = { fd, nfd: fd, position: 0, path: '', flags: fd === 0 ? 0 : 1, tty: tty.isatty(fd), seekable: false };
  };
  FS.cwd = () => inside(process.cwd());
  const readLink = wrapped((name) => {
    if (windows && !fs.lstatSync(name).isSymbolicLink()) throw new FS.ErrnoError(ERRNO_CODES.EINVAL); // some disks of Windows give other errors
    return inside(fs.readlinkSync(name));
  });
  FS.readlink = (name) => {
    if (names.isRoot(name)) throw new FS.ErrnoError(ERRNO_CODES.EINVAL); // no link
    return names.linkOf(name) ?? readLink(name);
  };
  // Numbers of files have 64 bits on Windows. A number of JavaScript loses the last of them, which differ.
  if (windows)
    for (const stat of ['stat', 'lstat'])
      FS[stat] = wrapped((name) => Object.assign(fs[`${stat}Sync`](name), { ino: Number(BigInt.asUintN(53, fs[`${stat}Sync`](name, { bigint: true }).ino)) }));
  FS.open = wrapped((name, flags, mode) => {
    const writes = (flags & 3) !== 0;
    if (writes) note(name);
    const nfd = fs.openSync(name, NODEFS.flagsForNode(flags), mode), status = fs.fstatSync(nfd);
    if ((flags & 0o200000) !== 0 && !status.isDirectory()) { // O_DIRECTORY
      fs.closeSync(nfd);
      throw new FS.ErrnoError(ERRNO_CODES.ENOTDIR);
    }
    const fd = FS.nextfd(), node = { id: status.ino, mode: status.mode, node_ops: NODERAWFS, path: name };
    return FS.streams[fd] = { fd, nfd, position: 0, path: name, flags, node, tty: tty.isatty(nfd), seekable: status.isFile() || status.isDirectory() };
  });
  FS.llseek = wrapped((stream, offset, whence) => {
    if (!stream.seekable) throw new FS.ErrnoError(ERRNO_CODES.ESPIPE);
    const position = offset + (whence === 1 ? stream.position : whence === 2 ? fs.fstatSync(stream.nfd).size : 0);
    if (position < 0) throw new FS.ErrnoError(ERRNO_CODES.EINVAL);
    return stream.position = position;
  });
  FS.read = wrapped((stream, heap, offset, length, position) => {
    const at = position ?? (stream.seekable ? stream.position : null);
    let count = 0;
    try {
      count = patient(() => fs.readSync(stream.nfd, heap, offset, length, at));
    } catch (error) {
      if (error.code !== 'EOF') throw error; // how Windows ends a pipe
    }
    if (position === undefined) stream.position += count;
    return count;
  });
  FS.write = wrapped((stream, heap, offset, length, position) => {
    const append = (stream.flags & 0o2000) !== 0; // O_APPEND
    for (let done = 0; done < length;) {
      const at = position !== undefined ? position + done : stream.seekable && !append ? stream.position : null;
      const count = patient(() => fs.writeSync(stream.nfd, heap, offset + done, length - done, at));
      done += count;
      if (position === undefined) stream.position += count;
    }
    return length;
  });
  SYSCALLS.doAccess = (name, mode) => {
    try {
      fs.accessSync(outside(name), mode);
      return 0;
    } catch (error) {
      return -failed(error);
    }
  };
  FS.lookupNode = (folder, name) => { // of a listed folder
    const status = fs.lstatSync(nodePath.join(outside(folder.path), name), { throwIfNoEntry: false });
    return { id: status?.ino ?? 1, mode: status?.mode ?? 0o100000 };
  };
  // Node.js itself completes names that begin at the current folder (-100).
  const complete = SYSCALLS.calculateAt;
  SYSCALLS.calculateAt = (folder, name, empty) => folder === -100 && name ? name : complete(folder, name, empty);

  Module['names'] = names;
  Module['machineName'] = os.hostname();
  Module['systemName'] = os.type();
  Module['columns'] = workerData?.columns ?? 0;
};
