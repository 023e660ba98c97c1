#version 460
// 4. Writes the visibility buffer: the triangle's index plus one; 0 where nothing is drawn.
layout(location = 0) out uint id;
void main() { id = uint(gl_PrimitiveID) + 1u; }
