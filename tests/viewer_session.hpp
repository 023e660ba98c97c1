// A session of the viewer without a display, whose window only records calls.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "files/file_registry.hpp"
#include "requests.hpp"
#include "run_tool.hpp"
#include "viewer_state.hpp"

namespace cotan::test {

// Protects inputs as a command does, while it exists.
struct GuardedInputs {
    explicit GuardedInputs(bool again) { guardInputs(/*overwrite*/ false, again); }
    ~GuardedInputs() { guardInputs(/*overwrite*/ true); }
    GuardedInputs(const GuardedInputs&) = delete;
    GuardedInputs& operator=(const GuardedInputs&) = delete;
};

} // namespace cotan::test

namespace cotan::viewer {

namespace fs = std::filesystem;

struct WindowCalls { // of the window
    std::vector<glm::ivec2> sizes;
    std::string copied, folder;
    int lost = 0, shows = 0;
};

class RecordingWindow : public Window {
public:
    explicit RecordingWindow(WindowCalls& calls) : calls_(calls) {}
    std::vector<Event> poll(double) override { return {}; }
    std::vector<Event> interact(const Interface&, const std::vector<Event>& events) override { return events; }
    Status show(const Interface&, const Shown&) override
    {
        ++calls_.shows;
        return Done{};
    }
    Result<Image> showAndRead(const Interface&, const Shown&) override
    {
        ++calls_.shows;
        Image image;
        image.width = 2;
        image.height = 1;
        image.data.resize(8);
        for (std::size_t i = 0; i < 8; ++i)
            image.bytes8()[i] = std::uint8_t(i % 4 == 3 ? 255 : 20 * i);
        return image;
    }
    glm::ivec2 size() const override { return {64, 48}; }
    void resize(int width, int height) override { calls_.sizes.emplace_back(width, height); }
    void setTitle(const std::string&) override {}
    std::string clipboard() override { return pasted; }
    void setClipboard(const std::string& text) override { calls_.copied = text; }
    void askForFile(const std::string& folder) override { calls_.folder = folder; }
    FileAnswer fileAnswer() override { return answer; }
    void loseSurface() override { ++calls_.lost; }
    std::shared_ptr<Device> device() const override { return {}; }
    std::uint64_t imagesRead() const override { return 0; }
    void wake() override {}

    std::string pasted;
    FileAnswer answer;

private:
    WindowCalls& calls_;
};

// A session that draws small images on the reference renderer, without a display.
struct HeadlessSession {
    test::TemporaryFolder folder;
    WindowCalls calls;
    SessionOptions options;
    Parts parts;
    RecordingWindow* window;

    static State small()
    {
        State state;
        state.size = {64, 48};
        state.picture.device = "reference";
        state.picture.samples = 1;
        state.picture.ground = false;
        return state;
    }
    explicit HeadlessSession(State state = small()) : parts(std::move(state), quiet(options))
    {
        auto made = std::make_unique<RecordingWindow>(calls);
        window = made.get();
        parts.window = std::move(made);
    }
    static SessionOptions& quiet(SessionOptions& o)
    {
        o.common.quiet = true;
        o.common.threads = 1;
        return o;
    }
    State& state() { return parts.state; }

    Status ask(Request request)
    {
        parts.state.requests.push_back(std::move(request));
        return carryOutRequests(parts);
    }
    void work(const std::function<bool()>& until)
    {
        for (int i = 0; i < 6000 && !until(); ++i) { // at most a minute
            while (auto loaded = parts.loader.take())
                take(parts.state, *loaded);
            parts.pictures.receive(parts.state, true);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        EXPECT_TRUE(until());
    }
    void load(const std::string& file)
    {
        ASSERT_TRUE(ask(request::Load{file}));
        work([&] { return !parts.loader.busy(); });
    }
    void draw()
    {
        work([&] {
            parts.pictures.ask(parts.state); // as the session does: restored options are drawn again
            return parts.pictures.idle(parts.state);
        });
    }
    std::string in(const std::string& name) const { return (folder / name).string(); }
};

} // namespace cotan::viewer
