// The compiled half of the Python module: thin over include/carom. What Python does well, names and
// structured arrays, is in carom/__init__.py.
#include <carom/carom.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <cstring>
#include <optional>

namespace py = pybind11;

namespace {

/// Looks for Ctrl-C, and calls `progress`, while the work runs without Python's lock.
class Watch {
  public:
    explicit Watch(std::optional<py::function> progress) : progress_(std::move(progress)) {}

    carom::Control control() {
        return {stop_.get_token(), [this](double done) { look(done); }};
    }

    /// Runs `work` without the lock; what Python raised meanwhile is raised here.
    template <class Work>
    auto run(const Work& work) {
        try {
            py::gil_scoped_release release;
            return work();
        } catch (const carom::Stopped&) {
            if (!raised_) throw;
        }
        throw py::error_already_set(*raised_);
    }

  private:
    void look(double done) {
        constexpr std::chrono::milliseconds kBetween{50};
        const auto now = std::chrono::steady_clock::now();
        if (raised_ || now < next_) return;
        next_ = now + kBetween;
        py::gil_scoped_acquire acquire;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (progress_) (*progress_)(done);
        } catch (py::error_already_set& error) {
            raised_ = std::move(error);
            stop_.request_stop();
        }
    }

    std::stop_source stop_;
    std::optional<py::function> progress_;
    std::optional<py::error_already_set> raised_;
    std::chrono::steady_clock::time_point next_{};
};

static_assert(sizeof(carom::State) == 13 * sizeof(double), "states are read as rows of 13 doubles");

/// times x balls x 13: position, orientation (w, x, y, z), velocity, spin. No copy is made.
py::array states(const carom::Motion& motion, const std::vector<double>& times) {
    auto* values = new std::vector<carom::State>;
    py::capsule owner(values, [](void* p) { delete static_cast<std::vector<carom::State>*>(p); });
    {
        py::gil_scoped_release release;
        *values = motion.states(times);
    }
    const auto balls = static_cast<py::ssize_t>(motion.balls().size());
    return py::array_t<double>({static_cast<py::ssize_t>(times.size()), balls, py::ssize_t{13}},
                               reinterpret_cast<const double*>(values->data()), owner);
}

/// A column a field.
py::dict events(const carom::Motion& motion) {
    const std::vector<carom::Event> all = motion.events();
    py::dict columns;
    const auto add = [&](const char* name, auto value) {
        py::list column;
        for (const carom::Event& event : all) column.append(value(event));
        columns[name] = column;
    };
    add("time", [](const auto& e) { return e.time; });
    add("ball", [](const auto& e) { return e.ball; });
    add("other", [](const auto& e) { return e.other; });
    add("other_is_surface", [](const auto& e) { return e.other_is_surface; });
    add("kind", [](const auto& e) { return carom::name(e.kind); });
    add("point", [](const auto& e) { return e.point; });
    add("normal", [](const auto& e) { return e.normal; });
    add("approach_speed", [](const auto& e) { return e.approach_speed; });
    add("separation_speed", [](const auto& e) { return e.separation_speed; });
    add("restitution", [](const auto& e) { return e.restitution; });
    add("impulse", [](const auto& e) { return e.impulse; });
    add("tangential_impulse", [](const auto& e) { return e.tangential_impulse; });
    return columns;
}

/// height x width x 4.
py::array array_of(const carom::Picture& picture) {
    py::array_t<std::uint8_t> array({picture.height, picture.width, 4});
    std::memcpy(array.mutable_data(), picture.rgba.data(), picture.rgba.size());
    return array;
}

/// Grey, RGB or RGBA; rows x columns x channels.
carom::Picture picture_of(py::array_t<std::uint8_t, py::array::c_style> array) {
    const auto shape = [&](py::ssize_t i) { return static_cast<int>(array.shape(i)); };
    const bool grey = array.ndim() == 2;
    if (!grey && (array.ndim() != 3 || (array.shape(2) != 3 && array.shape(2) != 4)))
        throw py::value_error(
            "a picture has the shape (rows, columns), (rows, columns, 3) or "
            "(rows, columns, 4)");
    const int channels = grey ? 1 : shape(2);
    carom::Picture picture{shape(1), shape(0), {}};
    const auto pixels =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    picture.rgba.resize(4 * pixels);
    const std::uint8_t* in = array.data();
    for (std::size_t i = 0; i < pixels; ++i, in += channels)
        for (int c = 0; c < 4; ++c)
            picture.rgba[4 * i + static_cast<std::size_t>(c)] =
                c == 3 ? (channels == 4 ? in[3] : 255) : in[grey ? 0 : c];
    return picture;
}

void add_scene(py::module_& module) {
    using carom::Scene;
    py::class_<Scene>(module, "Scene")
        .def_property_readonly("title", &Scene::title)
        .def_property_readonly("duration", &Scene::duration)
        .def_property_readonly("balls", &Scene::balls)
        .def_property_readonly("surfaces", &Scene::surfaces)
        .def_property_readonly("radii", &Scene::radii)
        .def_property_readonly("masses", &Scene::masses)
        .def_property_readonly("size", &Scene::size)
        .def_property_readonly("fps", &Scene::fps)
        .def_property_readonly("stills", &Scene::stills)
        .def_property_readonly("warnings", &Scene::warnings);
    module.def("from_file", &Scene::from_file, py::call_guard<py::gil_scoped_release>());
    module.def("from_text", &Scene::from_text, py::call_guard<py::gil_scoped_release>());
    py::class_<carom::Diagnostic>(module, "Diagnostic")
        .def_readonly("error", &carom::Diagnostic::error)
        .def_readonly("file", &carom::Diagnostic::file)
        .def_readonly("line", &carom::Diagnostic::line)
        .def_readonly("column", &carom::Diagnostic::column)
        .def_readonly("message", &carom::Diagnostic::message)
        .def("__str__", [](const carom::Diagnostic& d) { return d.shown; });
}

void add_motion(py::module_& module) {
    using carom::Motion;
    py::class_<Motion>(module, "Motion")
        .def_property_readonly("duration", &Motion::duration)
        .def_property_readonly("balls", &Motion::balls)
        .def_property_readonly("surfaces", &Motion::surfaces)
        .def_property_readonly("hash", &Motion::hash)
        .def("states", &states)
        .def("events", &events)
        .def("peaks", [](const Motion& motion, std::size_t ball) {
            std::vector<std::pair<double, double>> rows;
            for (const carom::Peak& peak : motion.peaks(ball))
                rows.emplace_back(peak.time, peak.height);
            return rows;
        });
    module.def("simulate", [](const carom::Scene& scene, std::optional<py::function> progress) {
        Watch watch(std::move(progress));
        return watch.run([&] { return carom::simulate(scene, watch.control()); });
    });
}

/// rows x columns, or rows x columns x channels.
py::array array_of(const carom::Layer& layer) {
    const auto array = [&layer](const auto& values) -> py::array {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        std::vector<py::ssize_t> shape{layer.height, layer.width};
        if (layer.channels > 1) shape.push_back(layer.channels);
        return py::array_t<Value>(shape, values.data());
    };
    return layer.ids.empty() ? array(layer.values) : array(layer.ids);
}

void add_second_run(py::module_& module) {
    using carom::Against;
    py::class_<Against>(module, "Against")
        .def(py::init<carom::Scene, carom::Motion, bool>())
        .def_readonly("scene", &Against::scene)
        .def_readonly("motion", &Against::motion)
        .def_readonly("side", &Against::side);
    module.def("second_run", [](const carom::Scene& scene, std::optional<py::function> progress) {
        Watch watch(std::move(progress));
        return watch.run([&] { return carom::second_run(scene, watch.control()); });
    });
    module.def("layers",
               [](const carom::Scene& scene, const carom::Motion& motion, double time,
                  const std::vector<std::string>& names, const std::optional<Against>& against) {
                   std::vector<carom::Layer> all;
                   {
                       py::gil_scoped_release release;
                       all = carom::layers(scene, motion, time, names, against);
                   }
                   py::dict arrays;
                   for (const carom::Layer& layer : all)
                       arrays[py::str(layer.name)] = array_of(layer);
                   return arrays;
               });
}

void add_pictures(py::module_& module) {
    module.def("still", [](const carom::Scene& scene, const carom::Motion& motion, double time,
                           const std::optional<carom::Against>& against) {
        carom::Picture picture;
        {
            py::gil_scoped_release release;
            picture = carom::still(scene, motion, time, against);
        }
        return array_of(picture);
    });
    module.def("read_png", [](const std::string& path) { return array_of(carom::read_png(path)); });
    module.def("write_png", [](const std::string& path, py::array_t<std::uint8_t> picture) {
        carom::write_png(path, picture_of(picture));
    });
    module.def("compare", [](py::array_t<std::uint8_t> a, py::array_t<std::uint8_t> b) {
        const carom::Difference d = carom::compare(picture_of(a), picture_of(b));
        return py::make_tuple(d.same_size, d.largest, d.differing_pixels, d.pixels, d.psnr_db,
                              d.ssim);
    });
    module.def("film", [](const carom::Scene& scene, const carom::Motion& motion,
                          const std::string& path, const std::string& codec,
                          const std::string& quality, std::optional<int> crf, int threads,
                          bool overwrite, std::optional<py::function> progress,
                          const std::optional<carom::Against>& against,
                          const std::vector<std::string>& layers) {
        const carom::FilmOptions options{codec, quality, crf, threads, overwrite, against, layers};
        Watch watch(std::move(progress));
        return watch.run(
            [&] { return carom::film(scene, motion, path, options, watch.control()); });
    });
}

py::tuple tuple_of(const carom::Fit& fit) {
    return py::make_tuple(fit.restitution, fit.uncertainty, fit.low, fit.high,
                          fit.distance_per_velocity, fit.material);
}

}  // namespace

PYBIND11_MODULE(_carom, module) {
    static py::exception<carom::Error> error(module, "Error", PyExc_RuntimeError);
    static py::exception<carom::SceneError> scene_error(module, "SceneError", error.ptr());
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const carom::SceneError& e) {
            py::object instance = py::reinterpret_borrow<py::object>(scene_error)(e.what());
            instance.attr("diagnostics") = py::cast(e.diagnostics());
            PyErr_SetObject(scene_error.ptr(), instance.ptr());
        } catch (const carom::Error& e) {
            PyErr_SetString(error.ptr(), e.what());
        }
    });
    add_scene(module);
    add_motion(module);
    add_second_run(module);
    add_pictures(module);
    module.def(
        "fit_drops", [](const std::vector<double>& drops, const std::vector<double>& rebounds,
                        double constant, double velocity, std::optional<double> reading_error) {
            return tuple_of(carom::fit_drops(drops, rebounds, constant, velocity, reading_error));
        });
    module.def("fit_intervals", [](const std::vector<double>& intervals, double constant,
                                   double velocity, std::optional<double> reading_error) {
        return tuple_of(carom::fit_intervals(intervals, constant, velocity, reading_error));
    });
    module.attr("__version__") = carom::version();
}
