// Reads models on its own thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "state.hpp"

namespace cotan::viewer {

struct Loaded {
    std::vector<std::string> high;      // files, if this is the detailed model
    bool posed = false;                 // the same model at another time of its animation
    std::shared_ptr<const Model> model; // null if there is an error or another kind of result
    std::optional<std::vector<ProblemArea>> problemAreas;
    std::vector<std::string> faults; // of maps and edges; after the model, because checking is slower than drawing
    std::optional<Error> error;
    double seconds = 0;
};

// Puts a result into the state. If a model could not be read, the state keeps the previous one and the error.
void take(State& state, const Loaded& loaded);

class Loader {
public:
    // done: called on the loader's thread when take() has something to return.
    explicit Loader(std::function<void()> done);
    ~Loader();

    // Reads this model next. Waiting requests are dropped; the result of a read in progress is discarded.
    void read(const PictureOptions& options);
    // Reads a detailed model from these files, all into one scene, after the model. Replaces a waiting one. options:
    // limits and axes, as for the model.
    void readHigh(const PictureOptions& options, const std::vector<std::string>& files);
    // Poses the model that was read last, without reading its file or decoding its images again. Replaces a waiting
    // pose. Does nothing while a model is being read.
    void pose(const PictureOptions& options);
    // Searches a model for problem areas.
    void findProblemAreas(std::shared_ptr<const Model> model);
    std::optional<Loaded> take();
    bool busy() const;    // there are requests or results that were not taken yet
    bool reading() const; // a file is being read

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

} // namespace cotan::viewer
