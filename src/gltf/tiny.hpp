// tinygltf, without the parts that read files and images.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <fstream> // tinygltf leaves it out together with its file access, but needs it
#include <tiny_gltf.h>
