// Included by what SPIRV-Cross prints; all that is used of it is in metal_stdlib.
