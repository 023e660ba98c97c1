// A job process whose first word chooses what it does: tests use it for jobs that crash, hang and exhaust memory.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include "batch/child.hpp"
#include "files/file_registry.hpp"
#include "files/interrupt.hpp"
#include "files/output.hpp"

namespace {

[[noreturn]] void sleepForever()
{
    for (;;)
        std::this_thread::sleep_for(std::chrono::seconds(1));
}

int perform(const std::vector<std::string>& words)
{
    const std::string& what = words.at(0);
    if (what == "crash") {
        std::signal(SIGSEGV, SIG_DFL); // the address sanitizer's handler would exit normally
        std::raise(SIGSEGV);
    }
    if (what == "abort")
        std::abort();
    if (what == "killed")
        std::raise(SIGKILL);
    if (what == "hang")
        sleepForever();
    if (what == "stubborn") { // ignores the request to terminate
        std::signal(SIGTERM, SIG_IGN);
        sleepForever();
    }
    if (what == "wait") // wait SECONDS, without using the processor
        std::this_thread::sleep_for(std::chrono::duration<double>(std::atof(words.at(1).c_str())));
    if (what == "spin") { // spin SECONDS of processor time
        const double enough = std::atof(words.at(1).c_str());
        while (double(std::clock()) < enough * CLOCKS_PER_SEC)
            ;
    }
    if (what == "flaky") { // flaky FILE N: crashes the first N times
        int times = 0;
        std::ifstream(words.at(1)) >> times;
        std::ofstream(words.at(1)) << times + 1;
        if (times < std::atoi(words.at(2).c_str()))
            std::raise(SIGKILL);
    }
    if (what == "variables") { // variables TO NAME...: writes their values
        std::string text;
        for (std::size_t i = 2; i < words.size() && !words[i].starts_with("--"); ++i) { // until the batch's options
            const char* const value = std::getenv(words.at(i).c_str());
            text += std::string(value ? value : "none") + "\n";
        }
        return cotan::writeFileWhole(words.at(1), text) ? 0 : 4;
    }
    if (what == "eat") {
        std::vector<std::vector<char>> all;
        for (;;)
            all.emplace_back(8 << 20, 'x');
    }
    if (what == "loud") {
        std::puts("the beginning");
        for (int i = 0; i < 200000; ++i)
            std::puts("and so on, and so on");
        std::puts("the end");
    }
    if (what == "leave" && ::fork() == 0) // its child keeps running and holds standard output open
        sleepForever();
    if (what == "fail") {
        std::fputs(("cotan: error: " + words.at(2) + "\n").c_str(), stderr);
        return std::atoi(words.at(1).c_str());
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
    return cotan::isJobProcess(argc, argv) ? cotan::runJobProcess(argc, argv, perform) : 70;
}
