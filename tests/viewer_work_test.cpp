// What the viewer does beside changing its state: wishes fulfilled, models taken over, images drawn; with a window that
// only remembers what it was asked for.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <thread>

#include "cotan/image/file.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"
#include "viewer_state.hpp"
#include "wishes.hpp"

namespace cotan::viewer {
namespace {

namespace fs = std::filesystem;

struct Asked { // of the window
    std::vector<glm::ivec2> sizes;
    std::string copied, folder;
    int lost = 0, shows = 0;
};

class RememberingWindow : public Window {
public:
    explicit RememberingWindow(Asked& asked) : asked_(asked) {}
    std::vector<Event> poll(double) override { return {}; }
    std::vector<Event> interact(const Interface&, const std::vector<Event>& events) override { return events; }
    Status show(const Interface&, const Shown&) override
    {
        ++asked_.shows;
        return Done{};
    }
    Result<Image> read() override
    {
        Image image;
        image.width = 2;
        image.height = 1;
        image.data.resize(8);
        for (std::size_t i = 0; i < 8; ++i)
            image.bytes8()[i] = std::uint8_t(i % 4 == 3 ? 255 : 20 * i);
        return image;
    }
    glm::ivec2 size() const override { return {64, 48}; }
    void resize(int width, int height) override { asked_.sizes.emplace_back(width, height); }
    void setTitle(const std::string&) override {}
    std::string clipboard() override { return pasted; }
    void setClipboard(const std::string& text) override { asked_.copied = text; }
    void askForFile(const std::string& folder) override { asked_.folder = folder; }
    FileAnswer fileAnswer() override { return answer; }
    void loseSurface() override { ++asked_.lost; }
    std::string device() const override { return {}; }
    const std::vector<std::string>& messages() const override { return messages_; }
    void wake() override {}

    std::string pasted;
    FileAnswer answer;

private:
    Asked& asked_;
    std::vector<std::string> messages_;
};

// A session of a small image on the reference renderer, without a display.
struct At {
    test::TemporaryFolder folder;
    Asked asked;
    SessionOptions options;
    Parts parts;
    RememberingWindow* window;

    static State small()
    {
        State state;
        state.size = {64, 48};
        state.picture.device = "reference";
        state.picture.samples = 1;
        state.picture.ground = "off";
        return state;
    }
    explicit At(State state = small()) : parts(std::move(state), quiet(options))
    {
        auto made = std::make_unique<RememberingWindow>(asked);
        window = made.get();
        parts.window = std::move(made);
    }
    static SessionOptions& quiet(SessionOptions& o)
    {
        o.common.quiet = true;
        return o;
    }
    State& state() { return parts.state; }

    Status wish(Wish::Kind kind, const std::string& text = {}, glm::ivec2 size = {0, 0})
    {
        parts.state.wishes.push_back({kind, text, size});
        return fulfil(parts);
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
        ASSERT_TRUE(wish(Wish::Kind::load, file));
        work([&] { return !parts.loader.busy(); });
    }
    void draw()
    {
        work([&] {
            parts.pictures.ask(parts.state); // as the session does: what was put back is drawn again
            return parts.pictures.idle(parts.state);
        });
    }
    std::string in(const std::string& name) const { return (folder / name).string(); }
};

TEST(ViewerWishes, eachAsksTheWindowForOneThingOnce)
{
    At at;
    EXPECT_TRUE(at.wish(Wish::Kind::resize, "", {300, 200}));
    EXPECT_EQ(at.asked.sizes, (std::vector<glm::ivec2>{{300, 200}}));
    EXPECT_TRUE(at.wish(Wish::Kind::loseSurface));
    EXPECT_EQ(at.asked.lost, 1);
    EXPECT_TRUE(at.wish(Wish::Kind::copy, "some text"));
    EXPECT_EQ(at.asked.copied, "some text");
    EXPECT_EQ(at.state().said, "copied: some text");
    EXPECT_FALSE(at.parts.quits);
    EXPECT_TRUE(at.wish(Wish::Kind::quit));
    EXPECT_TRUE(at.parts.quits);
    EXPECT_EQ(at.asked.sizes.size(), 1u);
    EXPECT_EQ(at.asked.lost, 1);
    EXPECT_TRUE(at.state().wishes.empty());
    EXPECT_EQ(at.state().problem, "");
}

TEST(ViewerWishes, aPastedPathIsOpenedAndNoneIsSaid)
{
    At at;
    EXPECT_FALSE(at.wish(Wish::Kind::paste));
    EXPECT_NE(at.state().problem.find("paste: expected the path of a file"), std::string::npos) << at.state().problem;
    at.state().picture.model = "x.glb";
    at.window->pasted = " 'a map.png'\n";
    EXPECT_TRUE(at.wish(Wish::Kind::paste));
    EXPECT_EQ(at.state().a.normalMap, "a map.png");
}

TEST(ViewerWishes, theDialogBeginsInTheFolderOfTheModelAndWhatIsChosenIsOpened)
{
    At at;
    at.state().picture.model = at.in("sub/x.glb");
    at.window->answer = {FileAnswer::open, ""};
    EXPECT_TRUE(at.wish(Wish::Kind::chooseFile));
    EXPECT_EQ(at.asked.folder, at.in("sub/"));
    EXPECT_TRUE(at.parts.dialog.open());
    at.asked.folder.clear();
    EXPECT_TRUE(at.wish(Wish::Kind::chooseFile)); // one is open
    EXPECT_EQ(at.asked.folder, "");
    at.window->answer = {FileAnswer::closed, "file:///m/a%20b.png"};
    at.state().wishes.clear();
    EXPECT_TRUE(fulfil(at.parts));
    EXPECT_EQ(at.state().a.normalMap, "/m/a b.png");
    EXPECT_FALSE(at.parts.dialog.open());
    at.window->answer = {FileAnswer::closed, ""}; // nothing was chosen
    EXPECT_TRUE(at.wish(Wish::Kind::chooseFile));
    EXPECT_EQ(at.state().a.normalMap, "/m/a b.png");
}

TEST(ViewerWishes, theReportAndTheWindowAreWrittenWhereTheyAreToldTo)
{
    At at;
    EXPECT_TRUE(at.wish(Wish::Kind::writeReport, at.in("r.txt")));
    EXPECT_EQ(test::readWhole(at.folder / "r.txt"), reportOf(at.state()));
    EXPECT_TRUE(at.wish(Wish::Kind::writeWindow, at.in("w.png")));
    EXPECT_EQ(at.asked.shows, 1); // what is written is what is shown now
    const auto image = readImage(at.folder / "w.png");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 2);
    EXPECT_EQ(image->bytes8()[4], 80);
    for (const auto kind : {Wish::Kind::writeReport, Wish::Kind::writeWindow}) {
        at.state().problem.clear();
        const Status done = at.wish(kind, at.in("no/such/folder.png"));
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().kind, ErrorKind::output);
        EXPECT_EQ(at.state().problem, done.error().message);
    }
}

// The first failure is the one that is returned; later wishes are done all the same.
TEST(ViewerWishes, oneThatFailsDoesNotHoldBackTheOthers)
{
    At at;
    at.state().wishes = {{Wish::Kind::paste, "", {}},
                         {Wish::Kind::writeReport, at.in("no/such.txt"), {}},
                         {Wish::Kind::resize, "", {7, 5}}};
    const Status done = fulfil(at.parts);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("paste"), std::string::npos);
    EXPECT_NE(at.state().problem.find("such.txt"), std::string::npos);
    EXPECT_EQ(at.asked.sizes.size(), 1u);
}

TEST(ViewerWishes, imagesAreWrittenAsTheStateShowsThemUnderANameThatIsFree)
{
    At at;
    EXPECT_FALSE(at.wish(Wish::Kind::writeFile, at.in("a.png"))); // there is no model yet
    EXPECT_FALSE(fs::exists(at.folder / "a.png"));
    at.load("");
    const fs::path before = fs::current_path();
    fs::current_path(at.folder.path());
    std::ofstream(at.folder / "cotan-picture-1.png") << "taken";
    EXPECT_TRUE(at.wish(Wish::Kind::writeFile, "", {20, 10}));
    EXPECT_TRUE(at.wish(Wish::Kind::writeFile, "-", {30, 12}));
    EXPECT_TRUE(at.wish(Wish::Kind::writeFile, ".exr"));
    EXPECT_TRUE(at.wish(Wish::Kind::writeFile, "named.png", {40, 14}));
    fs::current_path(before);
    EXPECT_EQ(test::readWhole(at.folder / "cotan-picture-1.png"), "taken");
    const std::vector<std::tuple<const char*, int, int>> written = {{"cotan-picture-2.png", 20, 10},
                                                                    {"cotan-picture-3.png", 30, 12},
                                                                    {"cotan-picture-1.exr", 64, 48},
                                                                    {"named.png", 40, 14}};
    for (const auto& [name, width, height] : written) {
        const auto image = readImage(at.folder / name);
        ASSERT_TRUE(image) << name;
        EXPECT_EQ(image->width, width) << name;
        EXPECT_EQ(image->height, height) << name;
    }
    EXPECT_NE(at.state().said.find("-o named.png --size 40x14"), std::string::npos) << at.state().said;
    EXPECT_EQ(at.state().size, glm::ivec2(64, 48)); // and the window stays as it is
}

TEST(ViewerWishes, hotSpotsAreThoseOfTheModelThatIsShown)
{
    At at;
    EXPECT_TRUE(at.wish(Wish::Kind::findHotSpots)); // of nothing
    EXPECT_FALSE(at.parts.loader.busy());
    at.load("");
    EXPECT_TRUE(at.wish(Wish::Kind::findHotSpots));
    at.work([&] { return at.state().hotSpots.has_value(); });
    EXPECT_EQ(at.state().hotSpots->size(), hotSpots(at.state().model->scene).size());
}

TEST(ViewerWishes, anotherModelForgetsTheShapeTheVariantAndTheMoment)
{
    At at;
    test::write(test::quad(2), at.folder.path());
    State& s = at.state();
    s.picture.shape = "torus";
    at.load("");
    EXPECT_EQ(s.picture.shape, "torus");
    EXPECT_TRUE(s.model);
    EXPECT_EQ(s.loads, 1u);
    EXPECT_TRUE(s.recent.empty()); // a shape is no file
    s.picture.camera = "left";
    s.metered = 3;
    s.meteredFrom = "right";
    s.cameraMoved = true;
    s.statisticsOf = "old";
    s.playing = true;
    at.state().wishes.push_back({Wish::Kind::load, at.in("quad.gltf"), {}});
    loadWished(at.parts);
    EXPECT_EQ(s.loading, "quad.gltf");
    EXPECT_EQ(s.progress, 0);
    at.work([&] { return !at.parts.loader.busy(); });
    EXPECT_EQ(s.picture.model, at.in("quad.gltf"));
    EXPECT_EQ(s.picture.shape, "");
    EXPECT_EQ(s.picture.camera, "");
    EXPECT_EQ(s.meteredFrom, "");
    EXPECT_EQ(s.metered, 0);
    EXPECT_EQ(s.statisticsOf, "");
    EXPECT_FALSE(s.cameraMoved);
    EXPECT_FALSE(s.playing);
    EXPECT_EQ(s.loads, 2u);
    EXPECT_EQ(s.recent, std::vector<std::string>{at.in("quad.gltf")});
    s.cameraMoved = true; // read again, the hand's camera and what was metered stay
    s.metered = 2;
    const glm::vec3 eye = s.camera.eye += glm::vec3(1, 2, 3);
    const std::uint64_t number = s.model->number;
    at.load(at.in("quad.gltf"));
    EXPECT_EQ(s.camera.eye, eye);
    EXPECT_EQ(s.metered, 2);
    EXPECT_TRUE(s.cameraMoved);
    EXPECT_NE(s.model->number, number);
    EXPECT_EQ(s.recent.size(), 1u);
    EXPECT_EQ(s.loads, 3u);
    at.load(at.in("missing.glb")); // the last model stays, and why is said
    EXPECT_EQ(s.failedLoads, 1u);
    EXPECT_EQ(s.loads, 3u);
    EXPECT_EQ(s.picture.model, at.in("quad.gltf"));
    EXPECT_NE(s.problem.find("missing.glb"), std::string::npos) << s.problem;
    at.load(at.in("quad.gltf"));
    EXPECT_EQ(s.problem, "");
}

TEST(ViewerLoader, recentFilesAreTenTheLatestFirstAndEachOnce)
{
    State s;
    auto model = std::make_shared<Model>();
    const auto opened = [&](const std::string& file) {
        Loaded loaded;
        loaded.options.model = file;
        loaded.model = model;
        take(s, loaded);
    };
    for (int i = 0; i < 12; ++i)
        opened("/f/" + std::to_string(i) + ".glb");
    ASSERT_EQ(s.recent.size(), kMostRecent);
    EXPECT_EQ(s.recent.front(), "/f/11.glb");
    EXPECT_EQ(s.recent.back(), "/f/2.glb");
    opened("/f/x/../5.glb");
    EXPECT_EQ(s.recent.front(), "/f/5.glb");
    EXPECT_EQ(s.recent.size(), kMostRecent);
    EXPECT_EQ(std::ranges::count(s.recent, "/f/5.glb"), 1);
    EXPECT_EQ(s.loads, 13u);
}

TEST(ViewerLoader, posesOfAMovingModelKeepItsImagesAndTellTheirMoment)
{
    At at;
    test::write(test::movingQuad(), at.folder.path());
    at.load(at.in("quad.gltf"));
    State& s = at.state();
    ASSERT_EQ(s.model->animations.size(), 2u);
    s.cameraMoved = true;
    s.picture.animation = "high";
    const auto heightAt = [&](double time) {
        s.picture.time = time;
        EXPECT_TRUE(at.wish(Wish::Kind::pose));
        at.work([&] { return !at.parts.loader.busy(); });
        EXPECT_EQ(s.model->read.time, time);
        EXPECT_EQ(s.model->read.animation, "high");
        EXPECT_EQ(s.model->animations.size(), 2u);
        EXPECT_FALSE(s.model->scene.images.empty());
        return s.model->scene.instances.at(0).toWorld[3];
    };
    const glm::vec4 early = heightAt(1), late = heightAt(3);
    EXPECT_GT(glm::length(glm::vec3(late - early)), 0.1f);
    EXPECT_EQ(heightAt(1), early);
    EXPECT_EQ(s.loads, 1u);
    s.playing = true;
    s.picture.animation = "none of these"; // what cannot be done is not asked for any longer
    EXPECT_TRUE(at.wish(Wish::Kind::pose));
    at.work([&] { return !at.parts.loader.busy(); });
    EXPECT_EQ(s.picture.animation, "high");
    EXPECT_EQ(s.picture.time, 1);
    EXPECT_FALSE(s.playing);
    EXPECT_NE(s.problem.find("none of these"), std::string::npos) << s.problem;
    EXPECT_EQ(s.failedLoads, 0u); // its file can be read
}

TEST(ViewerLoader, aModelThatDoesNotMoveHasNoAnimationToGoTo)
{
    At at;
    at.load("");
    at.state().picture.animation = "0";
    EXPECT_TRUE(at.wish(Wish::Kind::pose));
    at.work([&] { return !at.parts.loader.busy(); });
    EXPECT_NE(at.state().problem.find("animation: expected a glTF model with animations"), std::string::npos);
    EXPECT_EQ(at.state().picture.animation, "");
}

// ---- images -----------------------------------------------------------------------------------------

TEST(ViewerPictures, aSideIsWhatItsOwnOptionsDrawAndIsDrawnOnceUntilTheyChange)
{
    At at;
    at.parts.pictures.ask(at.state()); // of no model
    EXPECT_TRUE(at.parts.pictures.idle(at.state()));
    at.load("");
    at.draw();
    State& s = at.state();
    EXPECT_EQ(s.pictures, 1u);
    EXPECT_GT(s.metered, 0); // found by the first image
    EXPECT_GT(s.drawSeconds, 0);
    EXPECT_NE(s.device.find("reference"), std::string::npos) << s.device;
    EXPECT_EQ(s.statisticsOf.find(" against exact"), s.statisticsOf.size() - 14) << s.statisticsOf;
    EXPECT_GT(s.statistics.count, 0);
    const auto same = [](const Image& a, const Image& b) { return a.data == b.data; };
    ASSERT_TRUE(at.parts.pictures.shown(s).picture);
    const Image first = *at.parts.pictures.shown(s).picture;
    EXPECT_EQ(first.width, 64);
    EXPECT_EQ(first.height, 48);
    const auto serial = at.parts.pictures.shown(s).serial;
    at.draw();
    EXPECT_EQ(s.pictures, 1u);
    EXPECT_EQ(at.parts.pictures.shown(s).serial, serial);
    s.b.frame = "paper-nodet";
    s.compare = Compare::flip;
    s.second = true;
    at.draw();
    EXPECT_EQ(s.pictures, 2u);
    EXPECT_NE(at.parts.pictures.shown(s).serial, serial);
    const Image second = *at.parts.pictures.shown(s).picture;
    EXPECT_FALSE(same(first, second));
    s.compare = Compare::divider;
    s.second = false;
    s.divider = 0.25f;
    at.draw();
    const Shown both = at.parts.pictures.shown(s);
    ASSERT_TRUE(both.picture && both.other);
    EXPECT_TRUE(same(*both.picture, first));
    EXPECT_TRUE(same(*both.other, second));
    EXPECT_EQ(both.divider, 16);
    EXPECT_EQ(s.statisticsOf, "first against second");
    s.compare = Compare::angle;
    at.draw();
    EXPECT_FALSE(at.parts.pictures.shown(s).other);
    EXPECT_FALSE(same(*at.parts.pictures.shown(s).picture, first));
    EXPECT_GT(s.statistics.maximum, 0.1);
}

TEST(ViewerPictures, degreesAtThePointerAreThoseOfItsPixel)
{
    At at;
    at.load("");
    State& s = at.state();
    s.b.frame = "paper-nodet";
    s.compare = Compare::angle;
    at.draw();
    double most = -1;
    int covered = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            s.pointer = {float(x) + 0.75f, float(y) + 0.25f};
            const double here = at.parts.pictures.degreesAtPointer(s);
            most = std::max(most, here);
            covered += here >= 0;
        }
    EXPECT_EQ(covered, int(s.statistics.count));
    EXPECT_NEAR(most, s.statistics.maximum, 1e-4);
    for (const glm::vec2 outside : {glm::vec2(-1, 5), {5, -1}, {64, 5}, {5, 48}}) {
        s.pointer = outside;
        EXPECT_LT(at.parts.pictures.degreesAtPointer(s), 0) << outside.x << " " << outside.y;
    }
    s.size = {63, 48}; // another size than the image has
    s.pointer = {30, 20};
    EXPECT_LT(at.parts.pictures.degreesAtPointer(s), 0);
}

TEST(ViewerPictures, whatCannotBeDrawnIsSaidAndTheOptionsThatCouldBeDrawnComeBack)
{
    At at;
    at.load("");
    at.draw();
    State& s = at.state();
    s.picture.environment = "evening";
    s.a.frame = "smooth";
    at.draw();
    const auto pictures = s.pictures;
    s.picture.environment = at.in("missing.hdr");
    s.a.frame = "exact";
    s.picture.camera = "left"; // what is no cause of it stays
    at.draw();
    EXPECT_NE(s.problem.find("missing.hdr"), std::string::npos) << s.problem;
    EXPECT_EQ(s.picture.environment, "evening");
    EXPECT_EQ(s.a.frame, "smooth");
    EXPECT_EQ(s.picture.camera, "left");
    at.draw();
    EXPECT_EQ(s.picture.environment, "evening");
    EXPECT_NE(s.problem, ""); // it stays until something is done about it
    EXPECT_GE(s.pictures, pictures);
}

// While the camera is moved an image that took more than a twentieth of a second has 160,000 pixels of one sample.
TEST(ViewerPictures, aSlowOneIsDrawnSmallerWhileTheCameraMovesAndWholeWhenItRests)
{
    State state = At::small();
    state.size = {1000, 640};
    state.statisticsShown = false;
    At at(state);
    at.load("");
    at.draw();
    State& s = at.state();
    ASSERT_GT(s.drawSeconds, 0.05);
    EXPECT_EQ(at.parts.pictures.shown(s).picture->width, 1000);
    s.moving = true;
    at.draw();
    EXPECT_EQ(at.parts.pictures.shown(s).picture->width, 500);
    EXPECT_EQ(at.parts.pictures.shown(s).picture->height, 320);
    s.moving = false;
    at.draw();
    EXPECT_EQ(at.parts.pictures.shown(s).picture->width, 1000);
    EXPECT_EQ(at.parts.pictures.shown(s).picture->height, 640);
}

TEST(ViewerPictures, ofFloatsAreLightBeforeTheToneCurve)
{
    At at;
    at.load("");
    State& s = at.state();
    s.picture.exposure = "1";
    s.picture.toneMapping = "none";
    s.picture.background = "none";
    const Order order = orderOf(s);
    const auto bytes = at.parts.pictures.drawNow(order, false);
    Order light = order;
    light.first.use = light.second.use = PictureUse::radiance;
    const auto floats = at.parts.pictures.drawNow(light, true);
    ASSERT_TRUE(bytes && floats);
    EXPECT_EQ(bytes->data.size(), 4 * bytes->pixelCount());
    EXPECT_EQ(floats->data.size(), 16 * floats->pixelCount());
    std::size_t compared = 0;
    const float* linear = reinterpret_cast<const float*>(floats->data.data());
    for (std::size_t i = 0; i < 4 * bytes->pixelCount(); ++i) {
        const double c = linear[i];
        if (i % 4 == 3 || c < 0.02 || c > 0.98)
            continue;
        EXPECT_NEAR(bytes->bytes8()[i] / 255.0, 1.055 * std::pow(c, 1 / 2.4) - 0.055, 1.01 / 255); // sRGB
        ++compared;
    }
    EXPECT_GT(compared, 500u);
}

// ---- files that change --------------------------------------------------------------------------------

TEST(ViewerFiles, areLookedAtFourTimesASecondAndReadOnceTheyRested)
{
    test::TemporaryFolder folder;
    const fs::path file = folder / "a.glb";
    std::ofstream(file) << "one";
    Watch watch;
    EXPECT_FALSE(watch.changed(0)); // of nothing
    watch.on({file, file, fs::path()});
    EXPECT_FALSE(watch.changed(1));
    std::ofstream(file) << "longer";
    EXPECT_FALSE(watch.changed(1.2));  // not looked at yet
    EXPECT_FALSE(watch.changed(1.3));  // seen
    EXPECT_FALSE(watch.changed(1.58)); // rested for 0.28 s
    EXPECT_TRUE(watch.changed(1.84));  // 0.54 s
    std::ofstream(file) << "longer still";
    EXPECT_FALSE(watch.changed(3));
    EXPECT_FALSE(watch.changed(3.29));
    EXPECT_TRUE(watch.changed(3.6));
    EXPECT_FALSE(watch.changed(4));
}

TEST(ViewerFiles, everyFileThatIsShownIsWatchedAndReadAgainWhenItChanges)
{
    At at;
    test::write(test::quad(2), at.folder.path());
    at.load(at.in("quad.gltf"));
    State& s = at.state();
    for (const char* name : {"n.png", "n2.png", "base.png", "rough.png", "occlusion.png", "light.hdr"})
        std::ofstream(at.folder / name) << "x";
    s.a.normalMap = at.in("n.png");
    s.b.normalMap = at.in("n2.png");
    s.picture.maps.baseColor = at.in("base.png");
    s.picture.maps.metallicRoughness = at.in("rough.png");
    s.picture.maps.occlusion = at.in("occlusion.png");
    s.picture.environment = at.in("light.hdr");
    watchShown(at.parts);
    double now = 0;
    EXPECT_FALSE(at.parts.watch.changed(now));
    for (const char* name :
         {"n.png", "n2.png", "base.png", "rough.png", "occlusion.png", "light.hdr", "quad.gltf", "waves.png"}) {
        ASSERT_TRUE(fs::exists(at.folder / name)) << name;
        std::ofstream(at.folder / name, std::ios::app) << " ";
        EXPECT_FALSE(at.parts.watch.changed(now += 1)) << name;
        EXPECT_TRUE(at.parts.watch.changed(now += 1)) << name;
    }
}

} // namespace
} // namespace cotan::viewer
