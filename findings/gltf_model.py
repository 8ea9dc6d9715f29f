"""Writes a small valid glTF file, a triangle with texture coordinates and a camera, to the file that is named."""
import base64
import json
import struct
import sys

positions = struct.pack('<9f', 0, 0, 0, 1, 0, 0, 0, 1, 0)
texture = struct.pack('<6f', 0.25, 0.125, 1, 0, 0, 1)
data = positions + texture
json.dump({
    'asset': {'version': '2.0'},
    'scene': 0,
    'scenes': [{'nodes': [0, 1]}],
    'nodes': [{'mesh': 0}, {'camera': 0, 'translation': [0, 0, 5]}],
    'cameras': [{'type': 'perspective', 'perspective': {'yfov': 0.6, 'aspectRatio': 2, 'znear': 0.1, 'zfar': 100}}],
    'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1}}]}],
    'accessors': [
        {'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3', 'min': [0, 0, 0], 'max': [1, 1, 0]},
        {'bufferView': 1, 'componentType': 5126, 'count': 3, 'type': 'VEC2'}],
    'bufferViews': [
        {'buffer': 0, 'byteOffset': 0, 'byteLength': 36},
        {'buffer': 0, 'byteOffset': 36, 'byteLength': 24}],
    'buffers': [{'byteLength': len(data),
                 'uri': 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()}],
}, open(sys.argv[1], 'w'))
