// Prints how many vertices of a model must be split to store MikkTSpace tangents: tangents FILE
#include <cstdio>

#include <cotan/model.hpp>
#include <cotan/tangents.hpp>

int main(int argc, char** argv)
{
    using namespace cotan;
    const auto scene = loadScene(argc > 1 ? argv[1] : "", {.pixels = Pixels::none});
    if (!scene)
        return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 2;
    for (const Mesh& mesh : scene->meshes) {
        const auto tangents = mikktspaceTangents({mesh.positions, mesh.normals, mesh.texcoords[0], mesh.indices});
        std::printf("%s: %zu triangles, %zu tangents\n", mesh.name.c_str(), mesh.triangleCount(), tangents.size());
    }
}
