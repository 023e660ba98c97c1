// What bench/cards runs where the whole tool is not at hand: the machine code of every stage by the one driver that it
// is started with, in the lines that `cotan cost --cards` reads. Usage: card_cost NAME
#include <cstdio>

#include "cost/cards.hpp"

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
    std::fputs(cardsToCsv(*cards).c_str(), stdout);
    if (!cards->front().silence.empty())
        std::fprintf(stderr, "card_cost: %s\n", cards->front().silence.c_str());
    return cards->front().silence.empty() ? 0 : 3;
}
