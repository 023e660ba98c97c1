// load_time FILE...: compares reading models in this process and in a child process. Prints the best of nine loads
// each, in wall-clock time and in processor time of both processes together.
#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cotan/model.hpp"

namespace {

struct Cost {
    double wall = 1e9, processor = 1e9; // seconds
};

double processorSeconds()
{
    double sum = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        ::getrusage(who, &used);
        for (const timeval t : {used.ru_utime, used.ru_stime})
            sum += double(t.tv_sec) + double(t.tv_usec) * 1e-6;
    }
    return sum;
}

// Loads once in a process that has loaded nothing before, like the tool does.
Cost once(const char* file, const cotan::LoadLimits& limits)
{
    Cost cost;
    int ends[2];
    if (::pipe(ends) != 0)
        return cost;
    const pid_t process = ::fork();
    if (process == 0) {
        const auto start = std::chrono::steady_clock::now();
        const auto scene = cotan::loadScene(file, limits);
        if (!scene)
            fmt::print(stderr, "{}\n", scene.error().message);
        cost.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        cost.processor = processorSeconds();
        ::_exit(scene && ::write(ends[1], &cost, sizeof cost) == sizeof cost ? 0 : 1);
    }
    ::close(ends[1]);
    const bool got = ::read(ends[0], &cost, sizeof cost) == sizeof cost;
    ::close(ends[0]);
    ::waitpid(process, nullptr, 0);
    return got ? cost : Cost{};
}

Cost best(const char* file, const cotan::LoadLimits& limits)
{
    Cost least;
    for (int i = 0; i < 9; ++i) {
        const Cost cost = once(file, limits);
        least.wall = std::min(least.wall, cost.wall);
        least.processor = std::min(least.processor, cost.processor);
    }
    return least;
}

} // namespace

int main(int argc, char** argv)
{
    if (cotan::isReaderProcess(argc, argv))
        return cotan::runReaderProcess();
    cotan::LoadLimits child;
    child.sandbox.program = "/proc/self/exe";
    for (int i = 1; i < argc; ++i) {
        const Cost inProcess = best(argv[i], {}), inChild = best(argv[i], child);
        fmt::print("{}: {:.0f} ms, in a child {:.0f} ms, {:.2f} times; CPU {:.0f} ms, {:.0f} ms, {:.2f} times\n",
                   argv[i], 1e3 * inProcess.wall, 1e3 * inChild.wall, inChild.wall / inProcess.wall,
                   1e3 * inProcess.processor, 1e3 * inChild.processor, inChild.processor / inProcess.processor);
    }
}
