// Reads models on a thread of its own.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "state.hpp"

namespace cotan::viewer {

struct Loaded {
    PictureOptions options;             // that it was read with
    std::shared_ptr<const Model> model; // null: problem says why
    std::optional<std::vector<HotSpot>> hotSpots;
    std::string problem;
    double seconds = 0;
};

// Puts what was read into the state. A model that could not be read leaves the last one, and says why.
void take(State& state, const Loaded& loaded);

class Loader {
public:
    // done: called on the loader's thread where something can be taken.
    explicit Loader(std::function<void()> done);
    ~Loader();

    // Reads this next; what waits is dropped, what is being read goes on and is forgotten.
    void read(const PictureOptions& options);
    // Looks for hot spots of a model.
    void findHotSpots(std::shared_ptr<const Model> model);
    std::optional<Loaded> take();
    bool busy() const;

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

} // namespace cotan::viewer
