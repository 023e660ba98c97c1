"""Writes the kinds of files that the made test data consists of: PNG, OBJ, glTF and GLB."""

import base64
import json
import pathlib
import struct
import zlib

import numpy as np


# ---- PNG -----------------------------------------------------------------------------------------------------------

def chunk(name, data, checksum=None):
    """One chunk of a PNG file."""
    if checksum is None:
        checksum = zlib.crc32(name + data)
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", checksum)


def png_of(width, height, depth, colour, rows, extra=(), interlaced=0):
    """A PNG file around filtered rows. extra: chunks between the header and the rows."""
    header = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlaced)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + b"".join(extra) + chunk(b"IDAT", zlib.compress(rows, 9))
            + chunk(b"IEND", b""))


def png(texels):
    """A PNG file of an array (rows, columns, 1, 3 or 4 channels) of uint8 or uint16, whose first row is on top."""
    height, width, channels = texels.shape
    rows = texels.astype(texels.dtype.newbyteorder(">")).reshape(height, -1).view(np.uint8)
    # Filter 2 stores differences to the row above, which compress better.
    filtered = rows.copy()
    filtered[1:] -= rows[:-1]
    filtered = np.hstack([np.full((height, 1), 2, np.uint8), filtered])
    return png_of(width, height, 8 * texels.itemsize, {1: 0, 3: 2, 4: 6}[channels], filtered.tobytes())


# ---- OBJ -----------------------------------------------------------------------------------------------------------

def obj(mesh, polygons=None):
    """An OBJ file of a mesh of shapes.py: v points up here, and corners are v/vt/vn. polygons: used instead of its
    triangles, lists of vertices."""
    position, normal, uv = mesh.position, mesh.normal, np.stack([mesh.uv[:, 0], 1 - mesh.uv[:, 1]], 1)
    lines = []
    for word, values in (("v", position), ("vt", uv), ("vn", normal)):
        lines += [word + "".join(f" {x:.9g}" for x in row) for row in values.tolist()]
    for corners in mesh.triangles.tolist() if polygons is None else polygons:
        lines.append("f" + "".join(f" {i + 1}/{i + 1}/{i + 1}" for i in corners))
    return "\n".join(lines) + "\n"


# ---- glTF ----------------------------------------------------------------------------------------------------------

class Gltf:
    """A glTF file in the making: `root` is its JSON, `bytes` its buffer. Arrays become accessors by `add`."""

    kinds = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
    types = {np.dtype(np.float32): 5126, np.dtype(np.uint32): 5125, np.dtype(np.uint16): 5123, np.dtype(np.uint8): 5121}

    def __init__(self):
        self.root = {"asset": {"version": "2.0", "generator": "scripts/test-data"}, "scene": 0,
                     "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": []}
        self.bytes = b""
        self.files = {}

    def list(self, name, item):
        """Appends to a list of the JSON; returns the index."""
        self.root.setdefault(name, []).append(item)
        return len(self.root[name]) - 1

    def view(self, data, **more):
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        view = {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data), **more}
        self.bytes += data
        return self.list("bufferViews", view)

    def add(self, array, bounds=False, **more):
        """Appends an accessor. bounds: with min and max, as POSITION and times of animations need."""
        array = np.ascontiguousarray(array)
        if array.dtype == np.float64:
            array = array.astype(np.float32)
        columns = 1 if array.ndim == 1 else int(np.prod(array.shape[1:]))
        accessor = {"bufferView": self.view(array.tobytes(), **more), "componentType": self.types[array.dtype],
                    "count": len(array), "type": self.kinds[columns]}
        if bounds:
            flat = array.reshape(len(array), columns)
            accessor["min"], accessor["max"] = [[float(x) for x in f(flat, axis=0)] for f in (np.min, np.max)]
        return self.list("accessors", accessor)

    def image(self, texels, name=None):
        """Appends a texture of an array of texels; returns {"index": its index}. name: of a file beside a .gltf."""
        data = texels if isinstance(texels, bytes) else png(texels)
        image = {"bufferView": self.view(data), "mimeType": "image/png"} if name is None else {"uri": name}
        if name is not None:
            self.files[name] = data
        return {"index": self.list("textures", {"source": self.list("images", image)})}

    def extend(self, *names, required=False):
        for name in names:
            for key in ["extensionsUsed"] + ["extensionsRequired"] * required:
                if name not in self.root.get(key, []):
                    self.list(key, name)

    def mesh(self, mesh, material=None, name=None, node=None, **attributes):
        """Appends a mesh of shapes.py with a node; returns the primitive. attributes: further arrays by name."""
        arrays = {"POSITION": mesh.position, "NORMAL": mesh.normal, "TEXCOORD_0": mesh.uv,
                  "TANGENT": mesh.tangent, **attributes}
        primitive = {"attributes": {}}
        for key, array in arrays.items():
            if array is not None:
                primitive["attributes"][key] = self.add(array, bounds=key == "POSITION", target=34962)
        if mesh.triangles is not None:
            small = len(mesh.position) < 65535
            primitive["indices"] = self.add(mesh.triangles.reshape(-1).astype(np.uint16 if small else np.uint32),
                                            target=34963)
        if material is not None:
            primitive["material"] = material
        entry = {"primitives": [primitive]}
        if name:
            entry["name"] = name
        self.node({"mesh": self.list("meshes", entry), **({"name": name} if name else {}), **(node or {})})
        return primitive

    def node(self, node, child=False):
        """Appends a node to the list, and to the scene unless it is a child."""
        index = self.list("nodes", node)
        if not child:
            self.root["scenes"][0]["nodes"].append(index)
        return index

    def write(self, file):
        """Writes a .glb, or a .gltf with a .bin of the same name and its images beside it."""
        file = pathlib.Path(file)
        file.parent.mkdir(parents=True, exist_ok=True)
        root = {key: value for key, value in self.root.items() if value != []}
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        root["buffers"] = [{"byteLength": len(self.bytes)}]
        if file.suffix == ".glb":
            file.write_bytes(glb(root, self.bytes))
            return
        root["buffers"][0]["uri"] = file.with_suffix(".bin").name
        file.with_suffix(".bin").write_bytes(self.bytes)
        for name, data in self.files.items():
            (file.parent / name).parent.mkdir(parents=True, exist_ok=True)
            (file.parent / name).write_bytes(data)
        file.write_text(json.dumps(root, indent=1))

    def write_embedded(self, file):
        """Writes a .gltf whose buffer and images are data URIs."""
        root = {key: value for key, value in self.root.items() if value != []}
        root["buffers"] = [{"byteLength": len(self.bytes), "uri": data_uri(self.bytes, "application/octet-stream")}]
        file = pathlib.Path(file)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(root))


def data_uri(data, kind):
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


def glb(root, binary=b""):
    """The bytes of a GLB file."""
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    parts = struct.pack("<I4s", len(text), b"JSON") + text
    if binary:
        parts += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(parts)) + parts
