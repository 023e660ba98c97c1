// Frames of a deforming mesh, computed for every image by compute shaders.
#include <cstdio>
#include <exception>
#include <string>

#include "check.hpp"
#include "page.hpp"

static int usage()
{
    std::fprintf(stderr,
                 "usage: deforming_example check teapot|tube|seam|strange|large|MODEL\n"
                 "       deforming_example figure FILE.html\n");
    return 1;
}

int main(int count, char** words)
{
    const std::string what = count == 3 ? words[1] : "";
    if (what != "check" && what != "figure")
        return usage();
    int failure = 2;
    try {
        const Mesh rest = what == "check" ? named(words[2]) : Mesh();
        failure = 3;
        const Gpu gpu = openGpu();
        if (what == "check")
            return check(gpu, rest), 0;
        const std::string page = figure(gpu);
        std::FILE* out = std::fopen(words[2], "wb");
        if (!out || std::fwrite(page.data(), 1, page.size(), out) != page.size() || std::fclose(out) != 0)
            return std::perror(words[2]), 4;
        return 0;
    } catch (const std::exception& e) {
        return std::fprintf(stderr, "deforming_example: %s\n", e.what()), failure;
    }
}
