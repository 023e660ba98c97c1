// Times MikkTSpace on a wavy grid for bench/against-npm: tangents_time SIDE RUNS MESH_FILE
// Writes the mesh (vertex count, index count as uint32; positions, normals, uv as float32, indices as uint32). Then
// prints the median and best time of each generator, the minimum processor time of the calling thread and of all
// threads, and the peak memory of mikktspaceTangents besides its result.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cotan/tangents.hpp"
#include "grid.hpp"

namespace {

double median(std::vector<double> v)
{
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
}

double processorMilliseconds(clockid_t clock)
{
    timespec t{};
    ::clock_gettime(clock, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

// Times of one generator in milliseconds.
struct Times {
    std::vector<double> wall, thread, process;

    template<class Generate> void add(Generate generate)
    {
        const auto start = std::chrono::steady_clock::now();
        const double t = processorMilliseconds(CLOCK_THREAD_CPUTIME_ID),
                     p = processorMilliseconds(CLOCK_PROCESS_CPUTIME_ID);
        const auto out = generate();
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        wall.push_back(taken.count());
        thread.push_back(processorMilliseconds(CLOCK_THREAD_CPUTIME_ID) - t);
        process.push_back(processorMilliseconds(CLOCK_PROCESS_CPUTIME_ID) - p);
    }

    static double best(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }

    void print(const char* name, std::size_t triangles) const
    {
        std::printf(
            "%-56s %8.1f ms median, %8.1f ms best, CPU %8.1f ms this thread, %8.1f ms all, %6.2f M triangles/s\n", name,
            median(wall), best(wall), best(thread), best(process), double(triangles) / median(wall) * 1e-3);
    }
};

template<class Generate> void time(const char* name, int runs, std::size_t triangles, Generate generate)
{
    Times times;
    for (int i = 0; i < runs; ++i)
        times.add(generate);
    times.print(name, triangles);
}

// Alternates between one thread and two, so that other load on the machine affects both equally.
template<class Generate>
void inTurn(const char* nameOne, const char* nameTwo, int runs, std::size_t triangles, Generate generate)
{
    Times one, two;
    for (int i = 0; i < runs; ++i) {
        one.add([&] { return generate(1); });
        two.add([&] { return generate(2); });
    }
    one.print(nameOne, triangles);
    two.print(nameTwo, triangles);
    std::printf("two threads are %.2f times as fast as one, by the best times\n",
                Times::best(one.wall) / Times::best(two.wall));
}

// Alternates between smoothCotangents and mikktspaceTangents.
void smoothInTurn(const std::string& name, int runs, const cotan::MeshView& mesh, int threads)
{
    Times smooth, mikktspace;
    for (int i = 0; i < runs; ++i) {
        smooth.add([&] { return cotan::smoothCotangents(mesh, threads); });
        mikktspace.add([&] { return cotan::mikktspaceTangents(mesh, threads); });
    }
    smooth.print(name.c_str(), mesh.indices.size() / 3);
    std::printf("%.2f times the CPU time of mikktspaceTangents in the same runs, by the minima over all threads\n",
                Times::best(smooth.process) / Times::best(mikktspace.process));
}

template<class T> void write(std::ofstream& file, const std::vector<T>& values)
{
    file.write(reinterpret_cast<const char*>(values.data()), std::streamsize(values.size() * sizeof(T)));
}

double peakBytes()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) * 1024;
}

// Runs in a child process, because the system reports only the peak of a process.
void memory(const char* name, const cotan::MeshView& mesh)
{
    std::fflush(stdout);
    const pid_t child = ::fork();
    if (child == 0) {
        const double before = peakBytes(), triangles = double(mesh.indices.size() / 3);
        cotan::mikktspaceTangents(mesh);
        std::printf("cotan's memory, %-28s %3.0f bytes per triangle besides 48 for the result\n", name,
                    (peakBytes() - before) / triangles - 48);
        std::fflush(stdout);
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
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
        write(file,
              std::vector<std::uint32_t>{std::uint32_t(grid.positions.size()), std::uint32_t(grid.indices.size())});
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
    const cotan::bench::Grid loose = cotan::bench::unindexed(grid);
    cotan::bench::Grid joining = loose; // the first triangle has no uv area
    joining.texcoords[1] = joining.texcoords[0];
    memory("indexed", grid.view());
    memory("a vertex per corner", loose.view());
    memory("the same, one without direction", joining.view());
    time("cotan mikktspaceTangents, all threads", runs, triangles,
         [&] { return cotan::mikktspaceTangents(grid.view()); });
    inTurn("cotan mikktspaceTangents, one thread", "cotan mikktspaceTangents, two threads", runs, triangles,
           [&](int threads) { return cotan::mikktspaceTangents(grid.view(), threads); });
    time("cotan mikktspaceTangents, a vertex per corner", runs, triangles,
         [&] { return cotan::mikktspaceTangents(loose.view()); });
    for (const int threads : {1, 2}) {
        const std::string with = threads == 1 ? ", one thread" : ", two threads";
        smoothInTurn("cotan smoothCotangents" + with, runs, grid.view(), threads);
        smoothInTurn("cotan smoothCotangents, a vertex per corner" + with, runs, loose.view(), threads);
    }
    return 0;
}
