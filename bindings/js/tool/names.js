// Part of the generated wasm/cli.cjs: names of files of Windows for C++, whose library knows neither backslashes nor
// drives. C++ has C:/folder/file, and //server/share/file. To its library the first begins in the current folder; in
// every folder C: is a link to /C:, the drive. path: node:path of the system.
const namesOfFiles = (path) => {
  const windows = path.sep === '\\';
  const plain = (name) => name.replace(/^[\\/]{2}\?[\\/](?:UNC([\\/]))?/i, '$1$1').replace(/\\/g, '/'); // without \\?\
  return {
    // What a word of the command line is for C++. C:file is beside the current folder of that drive.
    fileOf: (word) => !windows ? word : plain(/^[A-Za-z]:(?![\\/])/.test(word) ? path.resolve(word) + /[\\/]?$/.exec(word)[0] : word),
    // A whole name of Node.js for C++.
    inside: (name) => windows ? plain(name).replace(/^[A-Za-z]:\//, '/$&') : name,
    // A name of C++ for Node.js: the last drive in it counts.
    outside: (name) => windows && typeof name === 'string' ? name.replace(/^(?:.*\/)?([A-Za-z]:)(?:$|(?=\/))(\/?)/, '$1/') : name,
    // Where the link to a drive leads; undefined for other names.
    linkOf: (name) => {
      const drive = windows && /(?:^|\/)([A-Za-z]:)$/.exec(name)?.[1];
      return drive && name !== `/${drive}` ? `/${drive}` : undefined;
    },
    // Drives, servers and their shares, which have no folder above them.
    isRoot: (name) => windows && /^(\/[A-Za-z]:|\/\/[^/]*(\/[^/]*)?)$/.test(name),
  };
};
