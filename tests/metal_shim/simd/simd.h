// Included by the output of SPIRV-Cross; everything that it uses is in metal_stdlib.
