// SPDX-License-Identifier: MIT
// Positions of tree nodes. Each leaf has its own column, a parent is centred over its first and last child,
// and trees are side by side. Therefore nodes of the same depth are at least one column apart, and edges do
// not cross.

import type { TreeNode } from "./model";

export interface Placed {
  node: TreeNode;
  x: number; // columns
  y: number; // depth
}

// Places the nodes in depth-first order, without recursion, because trees can be deep.
export function layout(roots: readonly TreeNode[]): Map<TreeNode, Placed> {
  const placed = new Map<TreeNode, Placed>();
  let column = 0;
  for (const root of roots) {
    const stack: { node: TreeNode; next: number }[] = [{ node: root, next: 0 }];
    while (stack.length > 0) {
      const top = stack[stack.length - 1];
      if (top.next < top.node.children.length) {
        stack.push({ node: top.node.children[top.next++], next: 0 });
        continue;
      }
      stack.pop();
      const { children } = top.node;
      const x = children.length === 0 ? column++
        : (placed.get(children[0])!.x + placed.get(children[children.length - 1])!.x) / 2;
      placed.set(top.node, { node: top.node, x, y: top.node.depth });
    }
  }
  return placed;
}
