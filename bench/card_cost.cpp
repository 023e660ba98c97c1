// A small replacement for the tool in bench/cards: prints the machine code statistics of every stage, compiled by the
// only driver it finds, in the format that `cotan cost --cards` reads. Usage: card_cost NAME
#include <cstdio>
#include <exception>

#include "cost/cards.hpp"

// The renderer's function, without its special cases: the renderer is not built for these cards.
namespace cotan {
std::string reason(const std::exception& e) { return e.what(); }
} // namespace cotan

int main(int count, char** words)
{
    using namespace cotan::cost;
    if (count != 2) {
        std::fputs("usage: card_cost NAME\n", stderr);
        return 1;
    }
    std::vector<const Row*> all;
    for (const Row& row : rows())
        all.push_back(&row);
    auto cards = machineCodeOfDevices(all, {});
    if (!cards || cards->empty()) {
        std::fprintf(stderr, "card_cost: %s\n", cards ? "the driver has no device" : cards.error().message.c_str());
        return 3;
    }
    cards->resize(1);
    cards->front().family = words[1];
    std::fputs(gpusToCsv(*cards).c_str(), stdout);
    if (!cards->front().silence.empty())
        std::fprintf(stderr, "card_cost: %s\n", cards->front().silence.c_str());
    return cards->front().silence.empty() ? 0 : 3;
}
