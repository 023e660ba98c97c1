// Requests of the viewer that do more than change its state, and how loaded models are taken over.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "cotan/image.hpp"
#include "quad_model.hpp"
#include "viewer_session.hpp"

namespace cotan::viewer {
namespace {

TEST(ViewerRequests, eachCallsTheWindowOnce)
{
    HeadlessSession at;
    EXPECT_TRUE(at.ask(request::Resize{{300, 200}}));
    EXPECT_EQ(at.calls.sizes, (std::vector<glm::ivec2>{{300, 200}}));
    EXPECT_TRUE(at.ask(request::LoseSurface{}));
    EXPECT_EQ(at.calls.lost, 1);
    EXPECT_TRUE(at.ask(request::Copy{"some text"}));
    EXPECT_EQ(at.calls.copied, "some text");
    EXPECT_EQ(at.state().message, "copied: some text");
    EXPECT_FALSE(at.parts.quits);
    EXPECT_TRUE(at.ask(request::Quit{}));
    EXPECT_TRUE(at.parts.quits);
    EXPECT_EQ(at.calls.sizes.size(), 1u);
    EXPECT_EQ(at.calls.lost, 1);
    EXPECT_TRUE(at.state().requests.empty());
    EXPECT_EQ(at.state().problem, "");
}

TEST(ViewerRequests, pastingOpensAPathOrReportsItsAbsence)
{
    HeadlessSession at;
    EXPECT_FALSE(at.ask(request::Paste{}));
    EXPECT_NE(at.state().problem.find("paste: expected a copied file path"), std::string::npos) << at.state().problem;
    at.state().picture.model = "x.glb";
    at.window->pasted = " 'a map.png'\n";
    EXPECT_TRUE(at.ask(request::Paste{}));
    EXPECT_EQ(at.state().a.normalMap, "a map.png");
}

TEST(ViewerRequests, theDialogStartsInTheModelsFolderAndOpensTheChoice)
{
    HeadlessSession at;
    at.state().picture.model = at.in("sub/x.glb");
    at.window->answer = {FileAnswer::open, ""};
    EXPECT_TRUE(at.ask(request::ChooseFile{}));
    EXPECT_EQ(at.calls.folder, at.in("sub/"));
    EXPECT_TRUE(at.parts.dialog.open());
    at.calls.folder.clear();
    EXPECT_TRUE(at.ask(request::ChooseFile{})); // one is open already
    EXPECT_EQ(at.calls.folder, "");
    at.window->answer = {FileAnswer::closed, "file:///m/a%20b.png"};
    at.state().requests.clear();
    EXPECT_TRUE(carryOutRequests(at.parts));
    EXPECT_EQ(at.state().a.normalMap, "/m/a b.png");
    EXPECT_FALSE(at.parts.dialog.open());
    at.window->answer = {FileAnswer::closed, ""}; // nothing was chosen
    EXPECT_TRUE(at.ask(request::ChooseFile{}));
    EXPECT_EQ(at.state().a.normalMap, "/m/a b.png");
}

TEST(ViewerRequests, reportsAndWindowImagesAreWrittenToTheGivenPath)
{
    HeadlessSession at;
    EXPECT_TRUE(at.ask(request::WriteReport{at.in("r.txt")}));
    EXPECT_EQ(test::readWhole(at.folder / "r.txt"), reportOf(at.state()));
    EXPECT_TRUE(at.ask(request::WriteWindow{at.in("w.png")}));
    EXPECT_EQ(at.calls.shows, 1); // the state is shown before the window is written
    const auto image = readImage(at.folder / "w.png");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 2);
    EXPECT_EQ(image->bytes8()[4], 80);
    const std::string nowhere = at.in("no/such/folder.png");
    for (const Request& request : {Request(request::WriteReport{nowhere}), Request(request::WriteWindow{nowhere})}) {
        at.state().problem.clear();
        const Status done = at.ask(request);
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().kind, ErrorKind::output);
        EXPECT_EQ(at.state().problem, done.error().message);
    }
}

// A session that began with files, as `view` starts it.
TEST(ViewerRequests, noneReplacesAFileThatTheSessionHasRead)
{
    HeadlessSession at;
    const test::GuardedInputs guarded(/*again*/ true);
    test::write(test::quad(2), at.folder.path());
    at.load(at.in("quad.gltf"));
    at.draw();
    fs::create_symlink("quad.bin", at.folder / "soft.png");
    fs::create_hard_link(at.folder / "quad.gltf", at.folder / "hard.png");
    for (const std::string name : {"waves.png", "soft.png", "hard.png"}) {
        const std::string before = test::readWhole(at.folder / name);
        for (const Request& request :
             {Request(request::WriteImage{at.in(name)}), Request(request::WriteWindow{at.in(name)}),
              Request(request::WriteReport{at.in(name)})}) {
            const Status done = at.ask(request);
            ASSERT_FALSE(done) << name;
            EXPECT_EQ(done.error().kind, ErrorKind::usage);
            EXPECT_NE(at.state().problem.find("which is an input"), std::string::npos) << at.state().problem;
            EXPECT_TRUE(test::readWhole(at.folder / name) == before) << name;
        }
    }
}

TEST(ViewerRequests, aSavedImageIsReplacedByTheNextUntilItIsOpened)
{
    HeadlessSession at;
    const test::GuardedInputs guarded(/*again*/ true);
    for (int i = 0; i < 2; ++i)
        EXPECT_TRUE(at.ask(request::WriteWindow{at.in("w.png")})) << at.state().problem;
    at.state().a.normalMap = at.in("w.png");
    at.load("");
    at.draw();
    const std::string before = test::readWhole(at.folder / "w.png");
    EXPECT_FALSE(at.ask(request::WriteWindow{at.in("w.png")}));
    EXPECT_FALSE(at.ask(request::WriteReport{at.in("w.png")}));
    EXPECT_TRUE(test::readWhole(at.folder / "w.png") == before);
}

// The first error is returned; later requests are still carried out.
TEST(ViewerRequests, aFailedRequestDoesNotStopTheOthers)
{
    HeadlessSession at;
    at.state().requests = {request::Paste{}, request::WriteReport{at.in("no/such.txt")}, request::Resize{{7, 5}}};
    const Status done = carryOutRequests(at.parts);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("paste"), std::string::npos);
    EXPECT_NE(at.state().problem.find("such.txt"), std::string::npos);
    EXPECT_EQ(at.calls.sizes.size(), 1u);
}

TEST(ViewerRequests, imagesAreWrittenUnderAFreeName)
{
    HeadlessSession at;
    EXPECT_FALSE(at.ask(request::WriteImage{at.in("a.png")})); // there is no model yet
    EXPECT_FALSE(fs::exists(at.folder / "a.png"));
    at.load("");
    const fs::path before = fs::current_path();
    fs::current_path(at.folder.path());
    std::ofstream(at.folder / "cotan-picture-1.png") << "taken";
    EXPECT_TRUE(at.ask(request::WriteImage{"", {20, 10}}));
    EXPECT_TRUE(at.ask(request::WriteImage{"-", {30, 12}}));
    EXPECT_TRUE(at.ask(request::WriteImage{".exr"}));
    EXPECT_TRUE(at.ask(request::WriteImage{"named.png", {40, 14}}));
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
    EXPECT_NE(at.state().message.find("-o named.png --size 40x14"), std::string::npos) << at.state().message;
    EXPECT_EQ(at.state().size, glm::ivec2(64, 48)); // the window keeps its size
}

TEST(ViewerRequests, problemAreasAreThoseOfTheShownModel)
{
    HeadlessSession at;
    EXPECT_TRUE(at.ask(request::FindProblemAreas{})); // there is no model yet
    EXPECT_FALSE(at.parts.loader.busy());
    at.load("");
    EXPECT_TRUE(at.ask(request::FindProblemAreas{}));
    at.work([&] { return at.state().problemAreas.has_value(); });
    EXPECT_EQ(at.state().problemAreas->size(), problemAreas(at.state().model->scene).size());
}

TEST(ViewerRequests, loadingAnotherModelResetsShapeVariantAndTime)
{
    HeadlessSession at;
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
    s.requests = {request::Resize{{7, 5}}, request::Load{at.in("quad.gltf")}, request::Pose{}};
    beginLoads(at.parts);
    ASSERT_EQ(s.requests.size(), 1u); // requests to the window stay queued
    EXPECT_TRUE(std::holds_alternative<request::Resize>(s.requests[0]));
    s.requests.clear();
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
    s.cameraMoved = true; // a reload keeps the user's camera and the metered exposure
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
    at.load(at.in("missing.glb")); // the last model stays, and the problem is reported
    EXPECT_EQ(s.failedLoads, 1u);
    EXPECT_EQ(s.loads, 3u);
    EXPECT_EQ(s.picture.model, at.in("quad.gltf"));
    EXPECT_NE(s.problem.find("missing.glb"), std::string::npos) << s.problem;
    at.load(at.in("quad.gltf"));
    EXPECT_EQ(s.problem, "");
}

TEST(ViewerLoader, recentFilesAreTheTenLatestWithoutRepeats)
{
    State s;
    const auto opened = [&](const std::string& file) {
        auto model = std::make_shared<Model>();
        model->read.model = file;
        Loaded loaded;
        loaded.model = model;
        take(s, loaded);
    };
    for (int i = 0; i < 12; ++i)
        opened("/f/" + std::to_string(i) + ".glb");
    ASSERT_EQ(s.recent.size(), kMaxRecent);
    EXPECT_EQ(s.recent.front(), "/f/11.glb");
    EXPECT_EQ(s.recent.back(), "/f/2.glb");
    opened("/f/x/../5.glb");
    EXPECT_EQ(s.recent.front(), "/f/5.glb");
    EXPECT_EQ(s.recent.size(), kMaxRecent);
    EXPECT_EQ(std::ranges::count(s.recent, "/f/5.glb"), 1);
    EXPECT_EQ(s.loads, 13u);
}

TEST(ViewerLoader, posesKeepTheImagesAndRecordTheirTime)
{
    HeadlessSession at;
    test::write(test::movingQuad(), at.folder.path());
    at.load(at.in("quad.gltf"));
    State& s = at.state();
    ASSERT_EQ(s.model->animations.size(), 2u);
    s.cameraMoved = true;
    s.picture.animation = "high";
    const auto heightAt = [&](double time) {
        s.picture.time = time;
        EXPECT_TRUE(at.ask(request::Pose{}));
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
    s.picture.animation = "none of these"; // an animation that fails is no longer requested
    EXPECT_TRUE(at.ask(request::Pose{}));
    at.work([&] { return !at.parts.loader.busy(); });
    EXPECT_EQ(s.picture.animation, "high");
    EXPECT_EQ(s.picture.time, 1);
    EXPECT_FALSE(s.playing);
    EXPECT_NE(s.problem.find("none of these"), std::string::npos) << s.problem;
    EXPECT_EQ(s.failedLoads, 0u); // the file can be loaded
}

TEST(ViewerLoader, animationsOfStaticModelsAreRefused)
{
    HeadlessSession at;
    at.load("");
    at.state().picture.animation = "0";
    EXPECT_TRUE(at.ask(request::Pose{}));
    at.work([&] { return !at.parts.loader.busy(); });
    EXPECT_NE(at.state().problem.find("animation: expected a glTF model with animations"), std::string::npos);
    EXPECT_EQ(at.state().picture.animation, "");
}

} // namespace
} // namespace cotan::viewer
