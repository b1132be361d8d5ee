#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests an installation of Grove: its programs, its libraries, and projects that use them.

    install_test.py SOURCE BUILD COMPILER CMAKE PYTHON [--long]

PYTHON: the interpreter for which the Python module is built; empty if it is not built. The test installs BUILD into
a temporary folder and builds dependent projects against it. With --long it also builds a project that contains Grove
as a subdirectory, without MPI and CBC (takes some minutes).
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, BUILD, COMPILER, CMAKE, PYTHON = (None,) * 5
IS_LONG = False
MAIN = """
#include <grove/grove.hpp>
#include <cstdio>
#include <cstring>
int main() {
  if (std::strcmp(grove::version(), GROVE_VERSION) != 0) return 2;
  const grove::Instance instance(grove::World::from_rows({"...."}),
                                 {{.id = "a", .start = {grove::Cell{0, 0}}, .goal = grove::Cell{3, 0}}}, {});
  const grove::Solution solution = grove::solve(instance);
  if (solution.gap() != 0.0) return 3;
  std::printf("cost %d\\n", static_cast<int>(solution.plan->cost));
}
"""
PROJECT = """
cmake_minimum_required(VERSION 3.22)
project(stranger LANGUAGES CXX)
{how}
add_executable(stranger main.cpp)
target_link_libraries(stranger {target})
"""
MPI_MAIN = """
#include <grove/grove.hpp>
#include <grove/mpi.hpp>
#include <cstdio>
template <class Act> bool refused(const char* field, Act act) {
  try { act(); } catch (const grove::InvalidArgument& error) { return error.field() == field; }
  return false;
}
int main(int argc, char** argv) {
  int provided = 0, rank = 0;
  const auto robots = [](int x) {
    return grove::Instance(grove::World::from_rows({"......", "...@@.", "......"}),
        {{.id = "a", .start = {grove::Cell{0, 0}}, .goal = grove::Cell{5, 2}},
         {.id = "b", .start = {grove::Cell{x, 0}}, .goal = grove::Cell{0, 2}},
         {.id = "c", .start = {grove::Cell{5, 2}}, .goal = grove::Cell{0, 0}}},
        {{.id = "t", .place = grove::Cell{2, 1}, .agents = {"a", "b", "c"}}});
  };
  try { grove::mpi::solve(robots(5)); return 3; } catch (const grove::Error&) {}
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  bool well = refused("/deterministic", [&] { grove::mpi::solve(robots(5), {.deterministic = true}); });
  well = well && refused("/instance", [&] { grove::mpi::solve(robots(5 - rank)); });
  well = well && refused(rank == 1 ? "/omega" : "",
                         [&] { grove::mpi::solve(robots(5), {.omega = rank == 1 ? -1.0 : 0.0}); });
  const grove::Instance instance = robots(5);
  for (int i = 0; i < 3; ++i) {
    const auto solution = grove::mpi::solve(instance, {.time_limit = 60});
    well = well && solution.has_value() == (rank == 0);
    if (!solution || !well) continue;
    well = solution->status == grove::Status::optimal && grove::check(instance, *solution).empty() &&
           solution->plan->cost == grove::solve(instance).plan->cost;
  }
  const auto walled = grove::mpi::solve(grove::Instance(grove::World::from_rows({".@."}),
      {{.id = "a", .start = {grove::Cell{0, 0}}, .goal = grove::Cell{2, 0}}}, {}));
  well = well && (rank != 0 || walled->status == grove::Status::infeasible);
  if (well) std::printf("rank %d is well\\n", rank);
  MPI_Finalize();
  return well ? 0 : 1;
}
"""
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
# Symbols that the shared library may export: the public API and template instances of the standard library.
EXPORTED = re.compile(r"^(grove::(?!detail::)|(typeinfo|typeinfo name|vtable|VTT) for grove::(?!detail::)|"
                   r"(\w+ )*std::|.* std::)")
# Parts of symbols that the shared library must not export, from bundled libraries and from grove::detail.
HIDDEN = re.compile(r"nlohmann|CLI::|YAML|pugi|fmt::|cereal|grove::detail")


def run(*command, folder=None, **environment):
    done = subprocess.run([str(word) for word in command], cwd=folder, text=True, timeout=280 if not IS_LONG else 1800,
                          env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        raise AssertionError(f"exit {done.returncode}: {command}\n{done.stdout}")
    return done.stdout


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.prefix = cls.folder / "pre fix"  # a path with a space
        run(CMAKE, "--install", BUILD, "--prefix", cls.prefix)
        cls.library = next(cls.prefix.glob("lib/**/libgrove.so"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def project(self, name, how, target):
        folder = self.folder / name
        folder.mkdir()
        (folder / "main.cpp").write_text(MAIN)
        (folder / "CMakeLists.txt").write_text(PROJECT.format(how=how, target=target))
        return folder

    def solves(self, folder, *options):
        run(CMAKE, "-S", folder, "-B", folder / "build", f"-DCMAKE_CXX_COMPILER={COMPILER}",
            f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Release", *options)
        run(CMAKE, "--build", folder / "build", "--parallel", "2")
        self.assertEqual(run(folder / "build/stranger"), "cost 3\n")

    def test_project_with_find_package_is_built(self):
        self.solves(self.project("shared", "find_package(grove 0.1 REQUIRED COMPONENTS core)", "grove::grove"))

    def test_project_with_the_static_library_is_built(self):
        folder = self.project("static", "find_package(grove REQUIRED)", "grove::grove_static")
        self.solves(folder)
        self.assertNotIn("libgrove", run("ldd", folder / "build/stranger"))

    def test_newer_version_is_not_found(self):
        folder = self.project("newer", "find_package(grove 0.2 REQUIRED)", "grove::grove")
        with self.assertRaisesRegex(AssertionError, "0.2"):
            self.solves(folder)

    def test_project_with_pkg_config_is_built(self):
        folder = self.project("pkg", "", "")
        flags = run("pkg-config", "--cflags", "--libs", "grove",
                    PKG_CONFIG_PATH=self.library.parent / "pkgconfig")
        flags = shlex.split(flags)  # splits like the shell
        run(COMPILER, "-std=c++20", "main.cpp", *flags, "-o", "stranger", folder=folder)
        self.assertEqual(run(folder / "stranger", LD_LIBRARY_PATH=self.library.parent), "cost 3\n")

    def test_minimal_example_is_built(self):
        example = next(self.prefix.glob("share/doc/**/minimal.cpp"))
        folder = self.project("example", "find_package(grove REQUIRED)", "grove::grove")
        shutil.copy(example, folder / "main.cpp")
        run(CMAKE, "-S", folder, "-B", folder / "build", f"-DCMAKE_CXX_COMPILER={COMPILER}",
            f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run(CMAKE, "--build", folder / "build")
        self.assertIn("one task more", run(folder / "build/stranger"))

    def test_lifelong_example_is_built(self):
        """Builds the lifelong example from public headers and the standard library only, as its README describes."""
        installed = next(self.prefix.glob("share/doc/**/lifelong"))
        readme = (Path(SOURCE) / "examples/lifelong/README.md").read_text()
        lines = [line for line in readme.splitlines() if line.startswith("    ")]
        folder = self.folder / "lifelong"
        shutil.copytree(installed, folder)
        (folder / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.22)\nproject(stranger LANGUAGES CXX)\n"
                                               + "\n".join(lines) + "\n")
        run(CMAKE, "-S", folder, "-B", folder / "build", f"-DCMAKE_CXX_COMPILER={COMPILER}",
            f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run(CMAKE, "--build", folder / "build", "--parallel", "2")
        program, grid = folder / "build/grove-lifelong", Path(SOURCE) / "benchmarks/data/rooms-32x32.map"
        output = run(program, grid, "--robots", "8", "--tasks", "20", "--steps", "20", "--turn-steps", "1")
        self.assertIn("20 of 20 errands done", output)
        with self.assertRaisesRegex(AssertionError, "exit 2.*\n.*--robots: found 'many'; expected a number from 1"):
            run(program, grid, "--robots", "many")

    def test_project_with_mpi_is_built(self):
        if not (self.prefix / "include/grove/mpi.hpp").exists():
            self.skipTest("Grove is built without MPI")
        folder = self.project("mpi", "find_package(grove REQUIRED COMPONENTS mpi)", "grove::mpi")
        (folder / "main.cpp").write_text(MPI_MAIN)
        run(CMAKE, "-S", folder, "-B", folder / "build", f"-DCMAKE_CXX_COMPILER={COMPILER}",
            f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run(CMAKE, "--build", folder / "build")
        output = run("mpirun", "--oversubscribe", "-np", "3", folder / "build/stranger", **MPI)
        self.assertEqual(sorted(output.splitlines()), [f"rank {i} is well" for i in range(3)])

    def test_python_module_is_installed(self):
        if not PYTHON:
            self.skipTest("Grove is built without Python")
        venv = self.folder / "venv"
        run(PYTHON, "-m", "venv", "--without-pip", venv)
        run(CMAKE, "--install", BUILD, "--component", "python", "--prefix", venv)
        output = run(venv / "bin/python", "-c",
                   "import grove; i = grove.instance_from_arrays(grove.World(['....']), [(0, 0)], [(3, 0)]);"
                   "print(grove.solve(i), grove.__version__, grove.__file__)", folder=self.folder)
        self.assertRegex(output, r"optimal, cost 3, .* \d+\.\d+\.\d+ \S+/venv/")

    def test_manual_completions_and_schemas_are_installed(self):
        for file in ("man/man1/grove-solve.1", "man/man1/grove-sim.1", "bash-completion/completions/grove",
                     "zsh/site-functions/_grove", "fish/vendor_completions.d/grove.fish",
                     "grove/schemas/instance.schema.json"):
            self.assertGreater((self.prefix / "share" / file).stat().st_size, 100, file)

    def test_shared_library_exports_only_the_public_api(self):
        exported = [line.split(" ", 2)[2] for line in run("nm", "-DC", "--defined-only", self.library).splitlines()]
        self.assertIn("grove::version()", exported)
        self.assertEqual([name for name in exported if not EXPORTED.match(name) or HIDDEN.search(name)], [])

    def test_soname_has_major_and_minor_version(self):
        self.assertRegex(run("readelf", "-d", self.library), r"SONAME.*\[libgrove\.so\.\d+\.\d+\]")

    def test_internal_headers_are_not_installed(self):
        headers = sorted((self.prefix / "include").rglob("*"))
        self.assertTrue(all(header.suffix == ".hpp" for header in headers if header.is_file()), headers)
        self.assertFalse([header for header in headers if header.name == "detail"])

    def test_programs_are_installed(self):
        program = self.prefix / "bin/grove"
        data = Path(SOURCE) / "benchmarks/data"
        plan = self.folder / "first.plan.json"
        run(program, "solve", data / "first.cts.json", "--quiet", "--output", plan)
        self.assertIn("valid", run(program, "check", data / "first.cts.json", plan))
        for command in ("report", "toio", "vda5050"):  # separate programs in other folders
            self.assertIn(f"grove {command}", run(program, command, "--help"))

    def test_cluster_scripts_are_installed(self):
        if not (self.prefix / "bin/grove-mpi").exists():
            self.skipTest("Grove is built without MPI")
        for name in ("solve.sbatch", "array.sbatch", "preempt.sbatch"):
            run("bash", "-n", self.prefix / "share/grove/cluster" / name)
        self.assertTrue(next(self.prefix.glob("share/doc/**/operators.md")).is_file())

    def test_grove_runs_without_the_picture_component(self):
        """Checks that grove depends on neither MPI nor graphics libraries and names the package that draws pictures."""
        program = self.prefix / "bin/grove"
        self.assertNotRegex(run("ldd", program), r"lib(mpi|cairo|X11|hwloc|OpenCL|tbb)\b")
        data = Path(SOURCE) / "benchmarks/data"
        run(program, "view", data / "first.cts.json", "--svg", self.folder / "a.svg", folder=self.folder)
        self.assertIn("<svg", (self.folder / "a.svg").read_text())
        bare = self.folder / "bare/bin"
        bare.mkdir(parents=True)
        shutil.copy(program, bare)
        with self.assertRaisesRegex(AssertionError, "exit 2.*\n.*Debian package grove-pictures"):
            run(bare / "grove", "view", data / "first.cts.json", "--svg", "b.svg", folder=self.folder)

    def test_uninstalling_removes_all_files(self):
        prefix = self.folder / "to uninstall"
        run(CMAKE, "--install", BUILD, "--prefix", prefix)
        manifest = (Path(BUILD) / "install_manifest.txt").read_text()
        for command in ("report", "toio", "vda5050"):
            run(prefix / "bin/grove", command, "--help")
        if PYTHON:
            module = next(prefix.glob("lib/python*/*-packages"))
            run(PYTHON, "-c", "import grove", PYTHONPATH=module)
        for file in manifest.splitlines():
            Path(file).unlink()
        self.assertEqual([file for file in prefix.rglob("*") if not file.is_dir()], [])

    def test_smoke_test_detects_a_broken_installation(self):
        output = run(self.prefix / "share/grove/smoke-test")
        self.assertRegex(output, "(?m)^ok +solve$")
        self.assertRegex(output, "(?m)^ok +library by CMake$")
        broken = self.folder / "broken"  # an installation whose grove always succeeds
        for name in ("bin", "share/grove"):
            (broken / name).mkdir(parents=True)
        shutil.copy(self.prefix / "share/grove/smoke-test", broken / "share/grove")
        (broken / "bin/grove").symlink_to("/bin/true")
        with self.assertRaisesRegex(AssertionError, "(?s)exit 1.*FAILED   check refuses a wrong plan"):
            run(broken / "share/grove/smoke-test")

    def test_project_with_grove_as_subdirectory_is_built(self):
        if not IS_LONG:
            self.skipTest("takes some minutes: --long")
        folder = self.project("inside", "add_subdirectory(grove)", "grove::grove")
        (folder / "grove").symlink_to(SOURCE)
        self.solves(folder, "-DGROVE_WITH_MPI=OFF", "-DGROVE_WITH_CBC=OFF", "-DGROVE_WITH_CADICAL=OFF")
        self.assertNotRegex(run("ldd", folder / "build/stranger"), "Cbc|mpi")


if __name__ == "__main__":
    IS_LONG = "--long" in sys.argv
    SOURCE, BUILD, COMPILER, CMAKE, PYTHON = sys.argv[1:6]
    SOURCE, BUILD = Path(SOURCE).resolve(), Path(BUILD).resolve()
    unittest.main(argv=sys.argv[:1], verbosity=2)
