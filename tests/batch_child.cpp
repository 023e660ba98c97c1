// A job process whose first word chooses what it does: tests use it for jobs that crash, hang and exhaust memory.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

#include "batch/child.hpp"
#include "files/file_registry.hpp"
#include "files/interrupt.hpp"
#include "files/output.hpp"

namespace {

int perform(const std::vector<std::string>& words)
{
    const std::string& what = words.at(0);
    if (what == "sh") // sh SCRIPT: becomes a shell
        ::execl("/bin/sh", "sh", "-c", words.at(1).c_str(), nullptr);
    if (what == "spin") { // spin SECONDS of processor time
        const double enough = std::atof(words.at(1).c_str());
        while (double(std::clock()) < enough * CLOCKS_PER_SEC)
            ;
    }
    if (what == "eat") {
        std::vector<std::vector<char>> all;
        for (;;)
            all.emplace_back(8 << 20, 'x');
    }
    if (what == "half") { // dies while writing
        const auto part = cotan::OutputFile::begin(words.at(1));
        if (part && cotan::writeBytes(*part, {}))
            std::raise(SIGKILL);
    }
    if (what == "copy") { // copy FROM TO [LOG]: appends a line to LOG on every run
        if (words.size() > 3)
            std::ofstream(words.at(3), std::ios::app) << words.at(2) + "\n";
        (void)cotan::noteInput(words.at(1));
        std::ifstream from(words.at(1));
        const std::string text{std::istreambuf_iterator<char>(from), {}};
        if (text.empty()) {
            std::fputs(("cotan: error: " + words.at(1) + ": no such file\n").c_str(), stderr);
            return 2;
        }
        return cotan::writeFileWhole(words.at(2), text) ? 0 : 4;
    }
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    cotan::removePartsOnInterrupt();
    return cotan::app::isJobProcess(argc, argv) ? cotan::app::runJobProcess(argc, argv, perform) : 70;
}
