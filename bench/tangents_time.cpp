// Times MikkTSpace on a wavy grid for bench/against-npm: tangents_time SIDE RUNS MESH_FILE
// Writes the mesh (vertex count, index count as uint32; positions, normals, uv as float32, indices
// as uint32), then prints the median and best seconds of each generator and the memory that
// mikktspaceTangents took at most, all the vectors it returns included.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

#include <sys/resource.h>

#include "cotan/tangents.hpp"
#include "grid.hpp"

namespace {

double median(std::vector<double> v)
{
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
}

template<class Generate> void time(const char* name, int runs, std::size_t triangles, Generate generate)
{
    std::vector<double> seconds;
    for (int i = 0; i < runs; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const auto out = generate();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        seconds.push_back(taken.count());
    }
    const double m = median(seconds);
    std::printf("%-44s %8.1f ms median, %8.1f ms best, %6.2f M triangles/s\n", name, m * 1e3,
                *std::min_element(seconds.begin(), seconds.end()) * 1e3, double(triangles) / m * 1e-6);
}

template<class T> void write(std::ofstream& file, const std::vector<T>& values)
{
    file.write(reinterpret_cast<const char*>(values.data()),
               std::streamsize(values.size() * sizeof(T)));
}

long peakKilobytes()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 4) {
        std::fprintf(stderr, "usage: tangents_time SIDE RUNS MESH_FILE\n");
        return 1;
    }
    const int side = std::atoi(argv[1]), runs = std::atoi(argv[2]);
    const cotan::bench::Grid grid = cotan::bench::makeGrid(side);
    {
        std::ofstream file(argv[3], std::ios::binary);
        write(file, std::vector<std::uint32_t>{std::uint32_t(grid.positions.size()),
                                               std::uint32_t(grid.indices.size())});
        write(file, grid.positions);
        write(file, grid.normals);
        write(file, grid.texcoords);
        write(file, grid.indices);
        if (!file) {
            std::fprintf(stderr, "tangents_time: cannot write %s\n", argv[3]);
            return 4;
        }
    }
    const std::size_t triangles = grid.indices.size() / 3;
    std::printf("%zu triangles\n", triangles);
    const long before = peakKilobytes();
    cotan::mikktspaceTangents(grid.view());
    std::printf("cotan's memory: %.0f bytes a triangle, of these 48 for the result\n",
                double(peakKilobytes() - before) * 1024 / double(triangles));
    time("cotan mikktspaceTangents, indexed", runs, triangles,
         [&] { return cotan::mikktspaceTangents(grid.view()); });
    const cotan::bench::Grid loose = cotan::bench::unindexed(grid);
    time("cotan mikktspaceTangents, a vertex a corner", runs, triangles,
         [&] { return cotan::mikktspaceTangents(loose.view()); });
    return 0;
}
