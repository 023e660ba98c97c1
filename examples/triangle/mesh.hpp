// The meshes that are drawn.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

struct Mesh {
    std::vector<glm::vec3> positions; // relative to the eye, which looks along -z
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texcoords; // v down
    std::vector<std::uint32_t> indices;
};

// Two flat sheets with sheared, half mirrored texture coordinates. The right sheet is seen from behind.
Mesh sheets();
Mesh teapot();
// The mesh with a copy of each vertex that mirrored and unmirrored triangles share, since averages must not mix them.
Mesh splitAtMirrors(const Mesh& mesh);
// The first mesh of a file, scaled into view. Prints an error and exits if there is none.
Mesh model(const std::string& file);
