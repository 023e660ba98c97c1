#include "in_child.hpp"

#include <array>

namespace cotan::cost {

namespace {

std::string phraseOf(const ChildEnd& end)
{
    switch (end.kind) {
    case ChildEnd::exited: return end.code == 0 ? "" : "ended with " + std::to_string(end.code);
    case ChildEnd::crashed: return "crashed (" + end.cause + ")";
    case ChildEnd::killed: return "was killed (" + end.cause + ")";
    case ChildEnd::tooLong:
    case ChildEnd::unknown: break;
    }
    return "was lost";
}

} // namespace

std::string inChild(int seconds, const ChildProgram& program, const std::function<void(std::string_view)>& line)
{
    Child child;
    if (const std::string why = child.start(program); !why.empty())
        return "could not be started: " + why;
    std::string kept; // start of a line that is not complete yet
    std::array<std::byte, 4096> buffer{};
    const auto receive = [&] {
        child.setLimits(Child::Clock::now() + std::chrono::seconds(seconds), {}, {});
        return child.receive(buffer);
    };
    while (const std::size_t n = receive()) {
        kept.append(reinterpret_cast<const char*>(buffer.data()), n);
        for (std::size_t end; (end = kept.find('\n')) != std::string::npos; kept.erase(0, end + 1))
            line(std::string_view(kept).substr(0, end));
    }
    const ChildEnd end = child.timedOut() ? ChildEnd{} : child.end();
    return child.timedOut() ? "took more than " + std::to_string(seconds) + " s" : phraseOf(end);
}

} // namespace cotan::cost
