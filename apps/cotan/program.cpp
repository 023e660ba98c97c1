#include "program.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

#include <fmt/format.h>

#ifdef COTAN_WITH_BATCH
#include "batch/child.hpp"
#endif
#include "common.hpp"
#include "cotan/files.hpp"
#include "cotan/model.hpp"
#include "files/file_registry.hpp"
#include "files/interrupt.hpp"
#include "files/system/program.hpp"
#include "terminal/file_words.hpp"
#include "terminal/printable.hpp"

namespace cotan::app {

namespace {

// Does not use fmt::print, which throws if standard error cannot be written.
int fail(const Error& error)
{
    std::fputs(fmt::format("cotan: error: {}\n{}", printable(asTyped(error.message)), error.advice).c_str(), stderr);
    return int(error.kind);
}

} // namespace

int finish(const Status& status)
{
    if (const auto refused = firstRefusal(); refused && !status)
        return fail(*refused); // a reader may have replaced its message
    if (!status)
        return fail(status.error());
    const Status printed = flushOutput();
    return printed ? 0 : fail(printed.error());
}

Status startLab()
{
    const std::filesystem::path self = programFile();
    const std::filesystem::path lab = self.parent_path() / ("cotan-lab" + self.extension().string());
    const std::string why = becomeProgram(lab);
    return unavailableError(fmt::format("{}: the program of this command cannot be started: {}", lab.string(), why));
}

int runProgram(int argc, char** argv, int (*commandLine)(std::vector<std::string>))
{
    const std::vector<std::string> words = beginProgram(argc, argv);
    std::vector<const char*> pointers;
    for (const std::string& word : words)
        pointers.push_back(word.c_str());
    const int count = int(words.size());
    if (isReaderProcess(count, pointers.data()))
        return runReaderProcess();
    sandboxByDefault({.program = sameProgram()});
    removePartsOnInterrupt();
    try {
#ifdef COTAN_WITH_BATCH
        if (isJobProcess(count, pointers.data()))
            return runJobProcess(count, pointers.data(), commandLine);
#endif
        return commandLine({words.begin() + std::min(count, 1), words.end()});
    } catch (const std::bad_alloc&) {
        return fail({ErrorKind::unavailable, "not enough memory"});
    } catch (const std::system_error& e) { // also from starting threads
        return fail({ErrorKind::unavailable,
                     e.code() == std::errc::resource_unavailable_try_again
                         ? "no more threads or processes are allowed here (ulimit -u)"
                         : std::string("unexpected: ") + e.what()});
    } catch (const std::exception& e) {
        return fail({ErrorKind::unavailable, std::string("unexpected: ") + e.what()});
    }
}

} // namespace cotan::app
