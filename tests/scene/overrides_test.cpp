// --set PATH=VALUE.
#include "core/failure.h"
#include "scene_testing.h"

namespace carom {
namespace {

const char* const kOverridden =
    "carom: 1\n"
    "materials: {rubber: {restitution: 0.5}, steel: {}}\n"
    "pairs: [{between: [rubber, steel], restitution: 0.8}]\n"
    "surfaces: [{name: floor, plane: {}, material: steel}]\n"
    "balls:\n"
    "  - {name: a, radius: 0.1, position: [0, 0, 1], material: rubber}\n"
    "  - {name: b, preset: tennis, drop_height: 1, at: [1, 0]}\n"
    "film: {stills: [0.5, 1.5]}\n"
    "overlay: {ruler: true}\n";

Scene with(const std::vector<std::string>& arguments) {
    std::vector<Override> overrides;
    for (const std::string& argument : arguments) overrides.push_back(parse_override(argument));
    return scene_of(kOverridden, overrides);
}

std::string wrong(const std::vector<std::string>& arguments) {
    std::vector<Override> overrides;
    for (const std::string& argument : arguments) overrides.push_back(parse_override(argument));
    return errors_of(kOverridden, overrides);
}

TEST(Overrides, GoByKeysNamesAndIndices) {
    EXPECT_EQ(with({"balls.a.mass=2"}).balls[0].mass, 2);
    EXPECT_EQ(with({"balls[1].mass=3"}).balls[1].mass, 3);
    EXPECT_EQ(with({"balls.b.preset=basketball"}).balls[1].preset, "basketball");
    EXPECT_EQ(with({"balls.a.position[2]=5"}).balls[0].position, Vec3(0, 0, 5));
    EXPECT_EQ(with({"surfaces.floor.material=rubber"}).surfaces[0].material, 1);
    EXPECT_EQ(with({"materials.steel.friction=0.25", "materials.rubber.friction=1",
                    "materials.tennis.friction=1"})
                  .materials[2]
                  .friction,
              0.25);
    EXPECT_EQ(with({"pairs[0].restitution=0.1"}).pairs[0].restitution, 0.1);
    EXPECT_EQ(with({"film.stills[1]=2.5"}).film.stills, (std::vector<double>{0.5, 2.5}));
    EXPECT_EQ(with({"film.stills=[1]"}).film.stills, (std::vector<double>{1}));
    EXPECT_EQ(with({"title=a=b"}).title, "a=b");
    EXPECT_EQ(with({"film.fps=30000/1001"}).film.fps.numerator, 30000);
    EXPECT_EQ(with({"film.speed=0.5", "film.speed=0.25"}).film.speed, 0.25) << "the last counts";
}

TEST(Overrides, MakeWhatIsMissingOnTheWay) {
    EXPECT_EQ(with({"simulation.step=0.001"}).simulation.step, 0.001);
    EXPECT_EQ(with({"simulation.gravity[2]=-1.62"}).simulation.gravity, Vec3(0, 0, -1.62));
    EXPECT_EQ(with({"film.size[0]=640"}).film.width_px, 640);
    EXPECT_EQ(with({"film.size[0]=640"}).film.height_px, 720);
    EXPECT_EQ(with({"overlay.ruler.to=3"}).overlay.ruler->to, 3);
    EXPECT_EQ(with({"defaults.ball.inertia=shell"}).balls[0].inertia_factor, 2.0 / 3.0);
    const Scene scene = with({"looks.blue={color: \"#00f\"}", "balls.a.look=blue"});
    EXPECT_EQ(scene.looks[static_cast<std::size_t>(scene.balls[0].look)].color.b, 1);
    EXPECT_EQ(with({"looks.x={}", "looks.x.color=#0f0"}).looks[0].color.g, 1);
    const Scene rough = with({"materials.tennis.virtual_body={distance: 1, velocity: 2}"});
    EXPECT_EQ(
        rough.materials[static_cast<std::size_t>(rough.balls[1].material)].virtual_body.distance_m,
        1);
}

TEST(Overrides, MistakesNameTheirPath) {
    EXPECT_EQ(wrong({"bals.a.mass=2"}),
              "--set bals.a.mass: error: unknown key 'bals'; did you mean 'balls'?\n");
    EXPECT_EQ(wrong({"balls.a.mas=2"}),
              "--set balls.a.mas: error: unknown key 'mas'; did you mean 'mass'?\n");
    EXPECT_EQ(wrong({"balls.c.mass=2"}),
              "--set balls.c.mass: error: 'balls' has no entry named 'c'; did you mean 'a'?\n");
    EXPECT_EQ(wrong({"balls[2].mass=2"}),
              "--set balls[2].mass: error: 'balls' has no entry [2]: it has 2, counted from 0\n");
    EXPECT_EQ(wrong({"materials.ruber.friction=2"}),
              "--set materials.ruber.friction: error: 'materials' has no 'ruber'; did you mean "
              "'rubber'?\n");
    EXPECT_EQ(wrong({"materials[0].friction=2"}),
              "--set materials[0].friction: error: 'materials' goes by names, not by [i]\n");
    EXPECT_EQ(wrong({"balls.a.mass=-1"}),
              "--set balls.a.mass: error: 'mass' must be above 0 kg, not -1\n");
    EXPECT_EQ(
        wrong({"balls.a.material=woood"}),
        "--set balls.a.material: error: there is no material 'woood'; known here: basketball, "
        "football, rubber, steel, table_tennis, tennis, volleyball\n");
    EXPECT_EQ(
        wrong({"balls.a.drop_height=1"}),
        "--set balls.a.drop_height: error: 'position' and 'drop_height' cannot stand together\n");
    EXPECT_EQ(
        wrong({"balls.a.position[3]=1"}),
        "--set balls.a.position[3]: error: 'position' has no entry [3]: it has 3, counted from "
        "0\n");
    EXPECT_EQ(wrong({"balls.a.mass.kg=1"}),
              "--set balls.a.mass.kg: error: 'mass' is a single value; nothing stands below it\n");
    EXPECT_EQ(wrong({"film.size.x=1"}),
              "--set film.size.x: error: 'size' is a list of values; an entry is [0], [1], ...\n");
    EXPECT_EQ(
        wrong({"overlay.ruler.at[0]=1"}),
        "--set overlay.ruler.at[0]: error: 'at' is not in the scene and has no default, so it "
        "has no entries; set it as a whole\n");
    EXPECT_EQ(wrong({"title=[1"}).substr(0, 33), "--set title: error: in the value:");
    EXPECT_EQ(wrong({"title="}), "--set title: error: in the value: the document is empty\n");
    for (const char* path : {"a..b=1", ".a=1", "a.=1", "film.size[=1", "film.size[]=1",
                             "film.size[x]=1", "film.size[123456789]=1"})
        EXPECT_NE(wrong({path}).find("a path is keys and names joined by dots"), std::string::npos)
            << path;
    EXPECT_EQ(errors_of("carom: 1", {{"balls.a.mass", "1"}}),
              "--set balls.a.mass: error: the scene has no 'balls'\n");
}

TEST(Overrides, MistakesOfTheFileAreStillFound) {
    EXPECT_EQ(errors_of("carom: 1\ntitel: x", {{"film.fps", "0"}}),
              "--set film.fps: error: 'fps' must be above 0 1/s, not 0\n"
              "t.yaml:2:1: error: unknown key 'titel'; did you mean 'title'?\n");
}

TEST(Overrides, AreSplitAtTheFirstEqualsSign) {
    EXPECT_EQ(parse_override("a.b=c=d").path, "a.b");
    EXPECT_EQ(parse_override("a.b=c=d").value, "c=d");
    EXPECT_THROW(parse_override("a.b"), Failure);
    EXPECT_THROW(parse_override("=1"), Failure);
}

}  // namespace
}  // namespace carom
