// SPDX-License-Identifier: MIT
// Behind the door: what the values of users stand for, and what is thrown to them.
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
  // Told as a user would have made it.
  static Instance told(detail::Instance instance);
};

// --- places; `field` says where, for InvalidArgument ---

detail::Place place_of(const detail::Map& map, const Place& place, const std::string& field);
Place told_place(const detail::Map& map, detail::Place place);
// Of an agent with this motion.
detail::Pose pose_of(const detail::Map& map, detail::Motion motion, const Pose& pose,
                     const std::string& field);
Pose told_pose(const detail::Map& map, detail::Motion motion, const detail::Pose& pose);

// --- plans ---

detail::Plan plan_of(const detail::Instance& instance, const Plan& plan);
// Throws InvalidArgument, `field` and what is wrong, if it is none.
detail::Plan valid_plan_of(const detail::Instance& instance, const Plan& plan,
                           const std::string& field);
Plan told_plan(const detail::Instance& instance, const detail::Plan& plan);
detail::Solution solution_of(const detail::Instance& instance, const Solution& solution);
Solution told_solution(const detail::Instance& instance, const detail::Solution& solution);

// As Options::omega is meant. Throws InvalidArgument.
detail::Omega omega_of(double omega);

// What `act` returns; what it throws as users are to see it.
template <class Act>
auto translated(Act&& act) {
  try {
    return act();
  } catch (const Error&) {
    throw;
  } catch (const detail::InputError& error) {
    throw InputError(error.what());
  } catch (const detail::InstanceError& error) {
    throw InvalidArgument("/" + error.field(), error.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(error.what());
  }
}

}  // namespace grove
