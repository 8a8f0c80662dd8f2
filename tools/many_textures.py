#!/usr/bin/env python3
"""Writes a glTF scene with many large textures, to measure --texture-memory.

    many_textures.py FOLDER [--count 128] [--size 4096] [--glb]

A floor and a wall of quads, each with a base colour texture of its own (RGBA, SIZE x SIZE pixels). 128 textures of 4096 x
4096 pixels have 8 GiB when decoded. --glb stores them in one binary file instead of PNG files.
"""
import argparse
import json
import math
import pathlib
import struct
import zlib


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(index, size):
    """A PNG of gradients and squares, different for each index. Rows repeat, so that it is compressed quickly."""
    rows = []
    for band in range(2):
        row = bytearray(1)
        for x in range(size):
            square = 255 if (x // 32 + band) % 2 else 96
            row += bytes((square, (x * 255 // size + 37 * index) % 256, 80 + (index * 29) % 128, 255))
        rows.append(bytes(row))
    packer = zlib.compressobj(1)
    data = b"".join(packer.compress(rows[y // 32 % 2]) for y in range(size)) + packer.flush()
    header = struct.pack(">IIBBBBB", size, size, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


class Scene:
    def __init__(self):
        self.binary = bytearray()
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "bufferViews": [], "accessors": [], "meshes": [],
                     "materials": [], "textures": [], "images": [], "nodes": [], "scenes": [{"nodes": []}]}

    def add(self, array, value):
        self.root[array].append(value)
        return len(self.root[array]) - 1

    def view(self, data):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.binary += data
        return self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.binary) - len(data), "byteLength": len(data)})

    def floats(self, vectors):
        view = self.view(struct.pack("<%df" % sum(map(len, vectors)), *[c for v in vectors for c in v]))
        kind = {2: "VEC2", 3: "VEC3"}[len(vectors[0])]
        limits = {"min": [min(c) for c in zip(*vectors)], "max": [max(c) for c in zip(*vectors)]}
        return self.add("accessors", {"bufferView": view, "componentType": 5126, "count": len(vectors), "type": kind, **limits})

    def quad(self, corner, u, v, image):
        at = [tuple(corner[k] + a * u[k] + b * v[k] for k in range(3)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        indices = self.add("accessors", {"bufferView": self.view(struct.pack("<6H", 0, 1, 2, 0, 2, 3)),
                                         "componentType": 5123, "count": 6, "type": "SCALAR"})
        texture = self.add("textures", {"source": self.add("images", image)})
        material = self.add("materials", {"pbrMetallicRoughness": {"baseColorTexture": {"index": texture},
                                                                   "metallicFactor": 0, "roughnessFactor": 1}})
        attributes = {"POSITION": self.floats(at), "TEXCOORD_0": self.floats([(0, 1), (1, 1), (1, 0), (0, 0)])}
        mesh = self.add("meshes", {"primitives": [{"attributes": attributes, "indices": indices, "material": material}]})
        self.root["scenes"][0]["nodes"].append(self.add("nodes", {"mesh": mesh}))

    def camera(self):
        self.root["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.01}}]
        tilt = math.radians(-8)
        self.root["scenes"][0]["nodes"].append(self.add("nodes", {
            "camera": 0, "translation": [0, 1.2, 2.6], "rotation": [math.sin(tilt / 2), 0, 0, math.cos(tilt / 2)]}))


def build(folder, count, size, embedded):
    scene = Scene()
    columns = max(1, round(math.sqrt(count / 2) * 1.4))
    rows = -(-count // columns)
    side = 4 / columns
    for i in range(count):
        data = png(i, size)
        if embedded:
            image = {"bufferView": scene.view(data), "mimeType": "image/png"}
        else:
            (folder / f"{i}.png").write_bytes(data)
            image = {"uri": f"{i}.png"}
        x, row = -2 + side * (i % columns), i // columns
        if row < rows // 2:
            scene.quad((x, 0, 1.5 - side * row), (side, 0, 0), (0, 0, -side), image)
        else:
            depth = 1.5 - side * (rows // 2)
            scene.quad((x, side * (row - rows // 2), depth), (side, 0, 0), (0, side, 0), image)
    scene.camera()
    return scene


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--count", type=int, default=128)
    arguments.add_argument("--size", type=int, default=4096)
    arguments.add_argument("--glb", action="store_true")
    a = arguments.parse_args()
    a.folder.mkdir(parents=True, exist_ok=True)
    scene = build(a.folder, a.count, a.size, a.glb)
    binary = bytes(scene.binary) + b"\0" * (-len(scene.binary) % 4)
    scene.root["buffers"] = [{"byteLength": len(binary)}]
    if a.glb:
        text = json.dumps(scene.root).encode()
        text += b" " * (-len(text) % 4)
        parts = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
        (a.folder / "scene.glb").write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(parts)) + parts)
    else:
        scene.root["buffers"][0]["uri"] = "scene.bin"
        (a.folder / "scene.bin").write_bytes(binary)
        (a.folder / "scene.gltf").write_text(json.dumps(scene.root))
    print(f"{a.count * a.size * a.size * 4 / 2**30:.3g} GiB of textures when decoded")


main()
