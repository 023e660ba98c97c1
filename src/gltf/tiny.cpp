// The one place where tinygltf's code is compiled. It parses the structure and nothing else:
// without its file access and image decoding it cannot open anything by itself.
#define TINYGLTF_IMPLEMENTATION
#include "tiny.hpp"
