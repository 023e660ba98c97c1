#include "files/sandbox/reader_process.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/named_values.hpp"
#include "core/one_line.hpp"
#include "core/try.hpp"
#include "files/bytes.hpp"
#include "files/file_registry.hpp"
#include "files/system/system.hpp"

namespace cotan {

namespace {

constexpr double kWallPerProcessor = 15; // allows for other load on the processor

std::string readerName(const ReaderRequest& request)
{
    const std::string extension = upperCase(lowerExtension(request.name));
    const bool known = extension.size() > 1 && extension.size() < 6;
    const std::string format = known ? extension.substr(1) + " " : "";
    if (request.kind == ReaderKind::draco)
        return "the decoder of Draco streams";
    return fmt::format("the reader of {}{}", format, request.kind == ReaderKind::model ? "files" : "images");
}

} // namespace

ReaderProcess::ReaderProcess(const ReaderRequest& request)
    : limits_(request.limits), name_(request.name), reader_(readerName(request)), fileBytes_(request.fileBytes),
      answer_([this](std::span<std::byte> bytes) { return child_.receive(bytes); },
              std::uint64_t(budgetFor(limits_, SIZE_MAX, SIZE_MAX).megabytes) << 20),
      question_([this](std::span<const std::byte> bytes) { return child_.send(bytes); })
{
    setLimits();
}

ReaderProcess::~ReaderProcess() = default;

Result<std::unique_ptr<ReaderProcess>> ReaderProcess::start(ReaderRequest request,
                                                            const std::function<void(WireOut&)>& more)
{
    std::unique_ptr<ReaderProcess> started(new ReaderProcess(request));
    std::vector<std::string> words = request.limits.sandbox.arguments;
    words.emplace_back(kReaderWord);
    if (const std::string why = started->child_.start({request.limits.sandbox.program, words}); !why.empty())
        return unavailableError(fmt::format("{}: cannot start the reader process {}: {}", request.name,
                                            request.limits.sandbox.program.string(), why));
    request.parent = thisProcess();
    exchangeRequest(started->question_, request);
    request.bytes = std::vector<std::byte>(); // free the bytes while the child reads; {} would keep their memory
    if (more)
        more(started->question_);
    COTAN_CHECK(started->await());
    return started;
}

Status ReaderProcess::await()
{
    question_.flush(); // a write error shows as a missing answer
    for (;;) {
        ReaderFrame frame = ReaderFrame::error;
        answer_.choice(frame, ReaderFrame::error);
        if (frame == ReaderFrame::expect) {
            std::uint64_t bytes = 0;
            answer_.number(bytes);
            decodedBytes_ += std::min(bytes, std::uint64_t(1) << 40);
            setLimits();
        }
        std::string input;
        if (frame == ReaderFrame::input)
            answer_.array(input);
        if (!answer_.good())
            return failure();
        if (frame == ReaderFrame::input)
            COTAN_CHECK(noteInput(input));
        if (frame == ReaderFrame::value)
            return Done{};
        if (frame == ReaderFrame::error) {
            Error error;
            exchangeError(answer_, error);
            if (error.kind < ErrorKind::usage || error.kind > ErrorKind::limit)
                answer_.refuse();
            if (!answer_.good())
                return failure();
            return reworded(error, oneLine(error.message, 4096));
        }
    }
}

void ReaderProcess::restartClock()
{
    began_ = Child::Clock::now();
    setLimits();
}

void ReaderProcess::setLimits()
{
    const ReaderBudget budget = budgetFor(limits_, fileBytes_, decodedBytes_);
    const std::chrono::duration<double> wall(kWallPerProcessor * budget.seconds);
    child_.setLimits(began_ + std::chrono::duration_cast<Child::Clock::duration>(wall), budget,
                     budgetFor(limits_, SIZE_MAX, SIZE_MAX));
}

Error ReaderProcess::failure()
{
    const ReaderBudget budget = budgetFor(limits_, fileBytes_, decodedBytes_);
    const ChildEnd end = !child_.timedOut() && answer_.ended() ? child_.end() : ChildEnd{};
    child_.kill();
    const std::string log = child_.messages();
    const auto line = [&](const std::string& what) {
        const std::string first = oneLine(log.substr(0, log.find('\n')), 160);
        return inputError(fmt::format("{}: {} {}{}", name_, reader_, what, first.empty() ? "" : ": " + first));
    };
    if (child_.timedOut() || end.kind == ChildEnd::tooLong)
        return line(fmt::format("took too long; the limit is {:.0f} seconds", budget.seconds));
    if (!answer_.ended())
        return line("returned invalid data");
    if (end.kind == ChildEnd::exited && end.code == kNoMemoryCode)
        return line(fmt::format("takes too much memory; the limit is {:.0f} MiB", budget.megabytes));
    if (end.kind == ChildEnd::killed || end.kind == ChildEnd::crashed)
        return line(fmt::format("{} ({})", end.kind == ChildEnd::killed ? "was killed" : "crashed", end.cause));
    return line("ended without a result");
}

} // namespace cotan
