#version 460
// 4. The visibility buffer holds the number of the triangle plus one; 0: nothing was drawn.
layout(location = 0) out uint id;
void main() { id = uint(gl_PrimitiveID) + 1u; }
