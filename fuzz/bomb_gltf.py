"""A builder of glTF models, for the makers of fuzz/bombs.py."""
import json
import struct

import bomb_images as pictures

LIMIT = 1_000_000  # bytes of a bomb, all its files together


def written(folder, name, data):
    file = folder / name
    file.write_bytes(data.encode()[:LIMIT] if isinstance(data, str) else data[:LIMIT])
    return file


class Gltf:
    """Builds a model: the JSON and one buffer."""

    def __init__(self):
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}]}
        self.data = b""

    def view(self, data):
        self.data += b"\0" * (-len(self.data) % 4)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.root["bufferViews"]) - 1

    def floats(self, values, width):
        rows = [values[i:i + width] for i in range(0, len(values), width)]
        accessor = {"bufferView": self.view(struct.pack(f"<{len(values)}f", *values)), "componentType": 5126,
                    "count": len(rows), "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}[width]}
        if width == 3:
            stored = struct.unpack(f"<{len(values)}f", struct.pack(f"<{len(values)}f", *values))
            accessor |= {"min": [min(stored[k::3]) for k in range(3)], "max": [max(stored[k::3]) for k in range(3)]}
        self.root["accessors"].append(accessor)
        return len(self.root["accessors"]) - 1

    def indices(self, values, wide=False):
        view = self.view(struct.pack(f"<{len(values)}{'I' if wide else 'H'}", *values))
        self.root["accessors"].append({"bufferView": view, "componentType": 5125 if wide else 5123,
                                       "count": len(values), "type": "SCALAR"})
        return len(self.root["accessors"]) - 1

    def add(self, key, value):
        self.root.setdefault(key, []).append(value)
        return len(self.root[key]) - 1

    def map(self, png):
        """Adds a material with this normal map and returns its index."""
        image = self.add("images", {"mimeType": "image/png", "bufferView": self.view(png)})
        return self.add("materials", {"normalTexture": {"index": self.add("textures", {"source": image})}})

    def triangle(self, uv=(0, 0, 1, 0, 0, 1), points=(0, 0, 0, 1, 0, 0, 0, 1, 0)):
        return {"POSITION": self.floats(points, 3), "NORMAL": self.floats([0, 0, 1] * (len(points) // 3), 3),
                "TEXCOORD_0": self.floats(uv, 2)}

    def place(self, primitives, **node):
        mesh = self.add("meshes", {"primitives": primitives})
        self.root["scenes"][0]["nodes"].append(self.add("nodes", {"mesh": mesh} | node))

    def write(self, folder):
        self.root["buffers"][0]["byteLength"] = len(self.data)
        if not self.data:
            del self.root["buffers"], self.root["bufferViews"]
        text = json.dumps(self.root, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = self.data + b"\0" * (-len(self.data) % 4)
        file = folder / "bomb.glb"
        file.write_bytes(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + 8 + len(data)) + struct.pack("<I4s", len(text), b"JSON")
                         + text + struct.pack("<I4s", len(data), b"BIN\0") + data)
        return file


def flat_map(side):
    return pictures.png(side, side, 8, 2, bytes([128, 128, 255]) * side)
