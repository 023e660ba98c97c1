// Reads models on a thread of its own.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "state.hpp"

namespace cotan::viewer {

struct Loaded {
    bool posed = false;                 // the model as before, at another moment
    PictureOptions options;             // that it was read with
    std::shared_ptr<const Model> model; // null where there is an error, or nothing else
    std::optional<std::vector<ProblemArea>> problemAreas;
    std::vector<std::string> faults; // of its maps; they come after the model, since looking takes longer than drawing
    std::optional<Error> error;
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
    // Puts the model that was read last into the pose that the options name, without reading its file and decoding its
    // images again; a pose that waits is dropped. Nothing while a model is being read.
    void pose(const PictureOptions& options);
    // Looks for hot spots of a model.
    void findProblemAreas(std::shared_ptr<const Model> model);
    std::optional<Loaded> take();
    bool busy() const;    // something was asked for and is not taken yet
    bool reading() const; // a file

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

} // namespace cotan::viewer
