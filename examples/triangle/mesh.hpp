// What is drawn, and what each way needs of it.
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

// Two flat sheets whose texture coordinates are sheared and half mirrored; the right one is seen from behind.
Mesh sheets();
Mesh teapot();
// The first mesh of a file, scaled into view. Ends the program with a line where there is none.
// The same with a copy of each vertex that mirrored and unmirrored triangles share: averages must not mix them.
Mesh splitAtMirrors(const Mesh& mesh);
Mesh model(const std::string& file);
