// SPDX-License-Identifier: MIT
// Conversions between the public API and grove::detail, and translation of exceptions.
#pragma once

#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <utility>

#include "grove/error.hpp"
#include "grove/instance.hpp"
#include "grove/plan.hpp"
#include "io/input_error.h"
#include "model/instance.h"
#include "model/plan.h"

namespace grove {

struct World::Data {
  std::shared_ptr<const detail::Map> map;
};

struct Instance::Data {
  World world;
  std::vector<Agent> agents;
  std::vector<Task> tasks;
  detail::Instance instance;
};

struct Access {
  static const std::shared_ptr<const detail::Map>& map(const World& world) {
    return world.data_->map;
  }
  static World world(std::shared_ptr<const detail::Map> map) {
    return World(std::make_shared<const World::Data>(World::Data{std::move(map)}));
  }
  static const detail::Instance& instance(const Instance& instance) {
    return instance.data_->instance;
  }
  // Converts to the public type.
  static Instance to_public(detail::Instance instance);
};

// --- places; `field`: JSON Pointer for InvalidArgument ---

detail::Place place_of(const detail::Map& map, const Place& place, const std::string& field);
Place public_place(const detail::Map& map, detail::Place place);
// Poses of an agent whose motion is `motion`.
detail::Pose pose_of(const detail::Map& map, detail::Motion motion, const Pose& pose,
                     const std::string& field);
Pose public_pose(const detail::Map& map, detail::Motion motion, const detail::Pose& pose);

// --- plans ---

detail::Plan plan_of(const detail::Instance& instance, const Plan& plan);
// Throws InvalidArgument with `field` and the reason if the plan is invalid.
detail::Plan valid_plan_of(const detail::Instance& instance, const Plan& plan,
                           const std::string& field);
Plan public_plan(const detail::Instance& instance, const detail::Plan& plan);
detail::Solution solution_of(const detail::Instance& instance, const Solution& solution);
Solution public_solution(const detail::Instance& instance, const detail::Solution& solution);

// Converts Options::omega. Throws InvalidArgument if it is neither from 0 to 1e6 nor infinite.
detail::Omega omega_of(double omega);

// Converts a JSON Pointer into an instance file to one into the public types: the key "cell" of a
// task is the member `place`.
std::string public_field(std::string field);

// Returns the result of `function`. Translates exceptions of `function` into those of the public
// API.
template <class Function>
auto with_public_exceptions(Function&& function) {
  try {
    return function();
  } catch (const Error&) {
    throw;
  } catch (const detail::InputError& error) {
    throw InputError(error.what());
  } catch (const detail::InstanceError& error) {
    throw InvalidArgument(public_field("/" + error.field()), error.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(error.what());
  }
}

}  // namespace grove
