// SPDX-License-Identifier: MIT
// The component that prepares the next tree while a worker has nothing else to do.
#include "engine/components.h"

namespace grove::detail {
namespace {

class PrepareTree : public WorkItem {
 public:
  explicit PrepareTree(TreeSupply& trees) : trees_(trees) {}

  std::string_view name() const override { return "prepare a tree"; }
  void perform(Workspace&) override { trees_.prepare_tree(); }
  void commit() override {}

 private:
  TreeSupply& trees_;
};

class PreparationWork : public WorkSource {
 public:
  PreparationWork(TreeSupply& trees, EffortAccount& account) : WorkSource(account), trees_(trees) {}

  std::unique_ptr<WorkItem> next() override {
    return trees_.claim_preparation() ? std::make_unique<PrepareTree>(trees_) : nullptr;
  }
  bool pays() const override { return false; }

 private:
  TreeSupply& trees_;
};

class TreePreparation : public Component {
 public:
  explicit TreePreparation(TreeSupply& trees) : trees_(trees) {}

  EffortTier tier() const override { return EffortTier::kPrimal; }
  std::unique_ptr<WorkSource> source(int /*worker*/) override {
    return std::make_unique<PreparationWork>(trees_, account_);
  }

 private:
  TreeSupply& trees_;
  EffortAccount account_;  // not used, because preparation is never due
};

}  // namespace

std::unique_ptr<Component> make_tree_preparation(const ComponentContext& context) {
  return std::make_unique<TreePreparation>(context.trees);
}

}  // namespace grove::detail
