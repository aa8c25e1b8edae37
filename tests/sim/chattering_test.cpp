// Scenes that random ones have found: steps of ODE that lifted balls for nothing, and contacts that
// chatter under large friction without end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "exact_scenes.h"
#include "scene/reader.h"

namespace carom::testing {
namespace {

/// Two balls lie in an island at hardly any speed, in an overlap of 1e-7 m.
constexpr const char* kSlowIsland = R"(carom: 1
simulation: {duration: 1.525, gravity: [7.2741095557695985, -13.925989389796646, 4.307795151860648]}
materials:
  m1: {virtual_body: {distance: 0.6019864021629681, velocity: 1}, friction: 0.39457525287120854}
surfaces:
  - {name: s0, plane: {normal: [1, 0, 0], offset: -1.5}, material: m1}
  - {name: s1, plane: {normal: [-1, 0, 0], offset: -1.5}, material: m1}
  - {name: s2, plane: {normal: [0, 1, 0], offset: -1.5}, material: m1}
  - {name: s3, plane: {normal: [0, -1, 0], offset: -1.5}, material: m1}
  - {name: s4, plane: {normal: [0, 0, 1], offset: -1.5}, material: m1}
  - {name: s5, plane: {normal: [0, 0, -1], offset: -1.5}, material: m1}
  - {name: s6, capsule: {from: [-1.329563961854106, 0.7148469396132326, 0.4026422900795532], to: [-1.7934331680015136, 0.21616086833446624, 1.852238330782105], radius: 0.06618384377924415}, material: m1}
  - {name: s7, capsule: {from: [0.4613528079126066, 0.5760456635229274, -0.45462469265365235], to: [1.3012082458712568, -0.6131058983702062, -0.5100671683966205], radius: 0.2606774344788108}, material: m1}
  - {name: s8, sphere: {position: [0.9227303462504568, -0.04133808357650759, 0.4003441640256735], radius: 0.06426563571695214}, material: m1}
  - {name: s9, capsule: {from: [0.4042400450599608, -1.20152228496609, 0.12029035851970349], to: [0.28342968430638915, -0.47838819144954625, 1.4424619658263151], radius: 0.0837413761949016}, material: m1}
balls:
  - {name: b0, radius: 0.023004663858569318, mass: 1, inertia: 0.6666666666666666, material: m1, position: [-0.134432264606559, 0.6319551345900596, 1.1186567757866333], velocity: [-0.9548904109706471, 1.335599533498914, -2.596684726638387]}
  - {name: b1, radius: 0.10777232859647788, mass: 1.0951017786575392, inertia: 0.4, material: m1, position: [0.3401857235447583, 0.10200786891079905, -0.41961488317604734], spin: [1.5258275103852934, 1.6915135667108596, 7.203463693379276]}
  - {name: b2, radius: 0.02798730166404182, mass: 1, inertia: 0.44240280264096865, material: m1, position: [1.1644238972513525, 1.0793920569177677, 0.5972041275286539], velocity: [1.9668482507191662, -0.4192425933680645, -0.13764360277858248]}
  - {name: b3, radius: 0.01987639987432997, mass: 1.7183487195243572, inertia: 0.18242972111761382, material: m1, position: [-1.23320725303126, 1.48012360012567, -0.7823686229273596], velocity: [4.023665146739062, 3.7741152871281365, 3.0535686587222086], spin: [25.098535565988698, 25.18307253374163, 34.15133870028074]}
  - {name: b4, radius: 0.02257607916992133, mass: 0.1891126975242282, inertia: 0.5705791964087403, material: m1, position: [1.4774239208300786, 0.7090673207793605, -0.7753292730093864]}
)";

/// Six balls in a corner are a pile.
constexpr const char* kSmallPile = R"(carom: 1
simulation: {duration: 1.417, gravity: [0, 0, -9.81]}
materials:
  m1: {restitution: 0, friction: 0.152584420232168}
  m2: {virtual_body: {distance: 1.0411731026039885, velocity: 1}, friction: 0.5066884790095355}
  m3: {restitution: 1, friction: 0.8908973428317233}
surfaces:
  - {name: s0, plane: {normal: [0.7237996603461821, -0.09589958069348445, 0.6833134874313291], offset: -1.5}, material: m2}
  - {name: s1, plane: {normal: [-0.7237996603461821, 0.09589958069348445, -0.6833134874313291], offset: -1.5}, material: m3}
  - {name: s2, plane: {normal: [0.5752245675783969, 0.6307995157625843, -0.5207769846757203], offset: -1.5}, material: m1}
  - {name: s3, plane: {normal: [-0.5752245675783969, -0.6307995157625843, 0.5207769846757203], offset: -1.5}, material: m1}
  - {name: s4, plane: {normal: [-0.38109152252050643, 0.769996909952568, 0.5117362700908539], offset: -1.5}, material: m2}
  - {name: s5, plane: {normal: [0.38109152252050643, -0.769996909952568, -0.5117362700908539], offset: -1.5}, material: m3}
  - {name: s6, capsule: {from: [0.6868008605839022, -1.2024526798909392, 0.19389786080911753], to: [0.9645948297219642, -1.6015765941427307, 0.3209535587628514], radius: 0.11354657673537928}, material: m1}
  - {name: s7, sphere: {position: [-0.22770526127365853, 0.7160304169594593, 0.863742940617505], radius: 0.050938692792430074}, material: m3}
balls:
  - {name: b0, radius: 0.02669337338454539, mass: 0.1843474808277282, inertia: 0.4, material: m3, position: [1.3052294499926012, 0.619782114731608, -0.5394632886251971], velocity: [-3.510067276828765, -2.059254292187034, 2.7347417652701584]}
  - {name: b1, radius: 0.029212300857591016, mass: 1, inertia: 0.4, material: m2, position: [0.6530554713930616, -0.4049085475041454, -0.29211551027082994]}
  - {name: b2, radius: 0.03714585930879609, mass: 2.8456683981753828, inertia: 0.4, material: m1, position: [-0.11570631346208904, -1.368946527688763, 0.1767819339130523]}
  - {name: b3, radius: 0.0668156742794024, mass: 1, inertia: 0.6666666666666666, material: m1, position: [0.6910083880251365, 0.20976871674575337, 1.0049372414129891], velocity: [0.6154456362905513, 0.49144823244529534, 0.37514137192481334], spin: [-10.09287677786645, -25.80441165268501, 7.52380807478488]}
  - {name: b4, radius: 0.037086493278590774, mass: 5.598420916994552, inertia: 0.2741793265675996, material: m2, position: [0.9098702619856948, 0.5752002309714535, 1.2578577723279718], velocity: [-0.2421388041364578, -0.21051002959858908, 0.16360225702187095]}
  - {name: b5, radius: 0.03173232585041193, mass: 7.170463663588059, inertia: 0.6666666666666666, material: m1, position: [0.8514137658849487, 0.6659436194520307, -1.0723143737051481], velocity: [-0.4565484192092595, 0.006087438624857844, 2.213873616960437]}
)";

/// A ball slides on one plane and rolls on another, with a friction of 11; another knocks on it.
constexpr const char* kKnockedAt = R"(carom: 1
simulation: {duration: 0.88, gravity: [10.278132447468584, -11.146898500629792, -13.235492667245664]}
materials:
  m1: {restitution: 1}
  m2: {virtual_body: {distance: 0.6019864021629681, velocity: 1}, friction: 3.3219840381679604}
surfaces:
  - {name: s0, plane: {normal: [-0.9876307274508571, -0.08452049561469463, 0.13206752824194917], offset: -1.5}, material: m1}
  - {name: s1, plane: {normal: [0.9876307274508571, 0.08452049561469463, -0.13206752824194917], offset: -1.5}, material: m2}
  - {name: s2, plane: {normal: [-0.12262055119659337, -0.10861072798747706, -0.9864927319500506], offset: -1.5}, material: m1}
  - {name: s3, plane: {normal: [0.12262055119659337, 0.10861072798747706, 0.9864927319500506], offset: -1.5}, material: m2}
  - {name: s4, plane: {normal: [0.09772280501057713, -0.9904847275890108, 0.09690334253155575], offset: -1.5}, material: m1}
  - {name: s5, plane: {normal: [-0.09772280501057713, 0.9904847275890108, -0.09690334253155575], offset: -1.5}, material: m2}
balls:
  - {name: b0, radius: 0.08151896952525368, mass: 1, inertia: 0.6666666666666666, material: m2, position: [0.27487075099752545, 1.3366160751319494, -1.2532525611268799], velocity: [2.9464119555784296, 6.063887410845067, 0.8912162974042287]}
  - {name: b1, radius: 0.01405712891867193, mass: 0.5415530785204722, inertia: 0.5428951289570463, material: m2, position: [1.3573152152544168, 1.0934653162678976, -0.4012827974940335], spin: [-15.601501562203783, 80.68746260692765, 83.27946535081364]}
  - {name: b2, radius: 0.013714916069489345, mass: 0.7584590578884837, inertia: 0.6666666666666666, material: m1, position: [1.1763553359852117, -0.2942990903677307, 0.7777773361475884], velocity: [-0.4370282677035591, -0.6138666888713675, 0.8465353950921399], spin: [6.978440186936135, 85.04862404216193, -283.7732230067301]}
  - {name: b3, radius: 0.08500786854440204, mass: 1, inertia: 0.4, material: m2, position: [0.4151135488677533, -1.3622445900783253, 0.08723122860189547], velocity: [-0.6562677123870219, -0.08578336985732263, -1.489416632292679], spin: [-14.40110595263128, -1.006843954628495, 8.491532490430794]}
  - {name: b4, radius: 0.0681320267919156, mass: 1, inertia: 0.4, material: m2, position: [0.3453045851198979, 0.7904611907336263, 0.34851565151183417], velocity: [-0.5163440286603358, 0.2677047070841235, -2.5877113326445245]}
)";

/// Two balls, each on a plane, rub against each other with a friction of 25.
constexpr const char* kRubbing = R"(carom: 1
simulation: {duration: 1.35, gravity: [0, 0, -9.81]}
materials:
  m1: {virtual_body: {distance: 0.25541281188299536, velocity: 1}}
  m2: {restitution: 1, friction: 3.572389569317942}
  m3: {virtual_body: {distance: 0.3163225577660846, velocity: 1}, friction: 5}
pairs:
  - {between: [m3, m1], restitution: 0.7213867186854171, friction: 0.28660326891867827}
surfaces:
  - {name: s0, plane: {normal: [0.3114819225575369, -0.57001190131597, 0.7603061516770818], offset: -1.5}, material: m3}
  - {name: s1, plane: {normal: [-0.3114819225575369, 0.57001190131597, -0.7603061516770818], offset: -1.5}, material: m3}
  - {name: s2, plane: {normal: [-0.940988722913907, -0.2964690786969566, 0.16323697107405677], offset: -1.5}, material: m3}
  - {name: s3, plane: {normal: [0.940988722913907, 0.2964690786969566, -0.16323697107405677], offset: -1.5}, material: m3}
  - {name: s4, plane: {normal: [0.13236024806834978, -0.7662848802728206, -0.6287195296764323], offset: -1.5}, material: m3}
  - {name: s5, plane: {normal: [-0.13236024806834978, 0.7662848802728206, 0.6287195296764323], offset: -1.5}, material: m2}
  - {name: s6, capsule: {from: [-0.7164307181869385, 0.44370021583394426, -0.9578450454913174], to: [-0.8591773839329839, 0.5145255164716278, -1.3688080450895197], radius: 0.08014268168461389}, material: m1}
  - {name: s7, sphere: {position: [-1.3502484551049083, -0.299129541356596, -0.20253012028987594], radius: 0.09626928846912507}, material: m1}
balls:
  - {name: b0, radius: 0.016072589944923603, mass: 1, inertia: 0.4, material: m2, position: [-0.27771826236296226, 0.8870088889662123, -1.1729716595268327], velocity: [-0.004524941169883336, 0.03510145694402423, 0.42109394743020145]}
  - {name: b1, radius: 0.269342343279134, mass: 6.446377550068291, inertia: 0.4, material: m3, position: [0.22513320525669123, -0.7277916402036863, -0.5201390487060087], velocity: [-0.25786288371437127, 1.0017095707445482, -2.9423361263140615], spin: [4.353801739409517, -9.538547033021837, 26.507215290049736]}
  - {name: b2, radius: 0.022854108592983806, mass: 0.7187085117082596, inertia: 0.4, material: m3, position: [-0.9966653478694272, 0.7941111708349284, -0.5945792467727431], velocity: [3.0323353268863626, -3.2969181945594555, 1.7197870780812876]}
  - {name: b3, radius: 0.021642291580768948, mass: 1, inertia: 0.4121212284261927, material: m1, position: [0.8503532832924217, 1.1071661154438694, -0.9561941981752626], velocity: [0.02361128105825731, 0.013539431872014496, -0.007979863675938108], spin: [12.769531912450573, -31.70846639884927, 71.41841428130779]}
  - {name: b4, radius: 0.2470335860569555, mass: 2.418520074332692, inertia: 0.6666666666666666, material: m3, position: [-0.831543492222711, -0.009898679308047775, 0.3838725061548831], velocity: [3.67936726216251, -1.8177917852804917, -5.088851754163989], spin: [1.396181484478916, 14.522382530488988, 15.270966828236775]}
  - {name: b5, radius: 0.013179631009262036, mass: 2.6177301808393003, inertia: 0.4, material: m2, position: [1.2651327373138175, -0.8937414325390751, 0.28004899339521727], velocity: [-4.264332921152465, 1.2594785075990216, -4.111777720758161], spin: [-2.158376548780297, 10.436924164202892, 1.5251525757077913]}
  - {name: b6, radius: 0.14863216586848244, mass: 1, inertia: 0.6666666666666666, material: m1, position: [0.9090360512547431, 0.6528528086823973, -1.2000851109340016], velocity: [0.5607381804927202, 1.5054477969170734, -0.825107083190598], spin: [-0.5510715077807088, 0.7228639338115075, 0.5247901387876912]}
  - {name: b7, radius: 0.036716644788590116, mass: 1, inertia: 0.48097372766640567, material: m2, position: [1.3086717487796762, 0.7500021257937755, -0.05810912991377992], velocity: [0.3161193386965876, -2.90860130301609, 3.349824312073172]}
)";

double energy_at(const Scene& scene, const Motion& motion, double t, bool before) {
    double sum = 0;
    for (std::size_t b = 0; b < scene.balls.size(); ++b) {
        const Ball& ball = scene.balls[b];
        const Trajectory& path = motion.balls[b];
        const BallState s =
            path.pieces()[path.piece_index(before ? std::nextafter(t, -1) : t)].at(t);
        sum += ball.mass *
               (0.5 * s.velocity.squaredNorm() +
                0.5 * ball.inertia_factor * ball.radius * ball.radius * s.spin.squaredNorm() -
                scene.simulation.gravity.dot(s.position - ball.position));
    }
    return sum;
}

/// J: over what it had been before, on both sides of the starts of all pieces.
double rise_of_energy(const Scene& scene, const Motion& motion) {
    std::vector<double> starts;
    for (const Trajectory& ball : motion.balls)
        for (const Piece& piece : ball.pieces())
            if (piece.start <= motion.duration) starts.push_back(piece.start);
    std::sort(starts.begin(), starts.end());
    starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
    double least = INFINITY, rise = 0;
    for (const double t : starts)
        for (const bool before : {true, false}) {
            if (before && t == 0) continue;
            const double now = energy_at(scene, motion, t, before);
            rise = std::max(rise, now - least);
            least = std::min(least, now);
        }
    return rise;
}

/// 9.5e-7 and 5.4e-5 J before: overlaps were moved apart at the start of a step out of what it was
/// yet to lose, or for nothing.
TEST(Chattering, PartingOverlapsIsPaidFor) {
    for (const char* text : {kSlowIsland, kSmallPile}) {
        const SceneResult read = read_scene(text, "overlaps.yaml");
        ASSERT_TRUE(read.scene);
        const SimulationResult result = simulate(*read.scene);
        EXPECT_GT(result.report.steps, 0);
        const double rise = rise_of_energy(*read.scene, result.motion);
        std::printf("energy rises by %.2g J at most (1e-8)\n", rise);
        EXPECT_LE(rise, 1e-8);
    }
}

/// 30,000 and 66,000 pieces before, and no end of the first one after 1.086 s: of pieces of 1e-12 s
/// none gets on. Steps of ODE take over, and the statistics say so.
TEST(Chattering, EndsInSteps) {
    for (const char* text : {kKnockedAt, kRubbing}) {
        const SceneResult read = read_scene(text, "chatter.yaml");
        ASSERT_TRUE(read.scene);
        const SimulationResult result = simulate(*read.scene);
        std::size_t pieces = 0;
        for (const Trajectory& ball : result.motion.balls) pieces += ball.pieces().size();
        std::printf("%zu pieces, given up %lld times\n", pieces,
                    static_cast<long long>(result.report.given_up));
        EXPECT_LE(pieces, 25'000u);
        EXPECT_TRUE(result.report.effects.at("last_resort").on);
    }
}

}  // namespace
}  // namespace carom::testing
