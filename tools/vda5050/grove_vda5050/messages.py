# SPDX-License-Identifier: MIT
"""Writes VDA 5050 orders for a route: the base (released nodes) and the horizon (nodes after the base)."""


def _number(value):
    return round(value, 6)


def _angle(value):
    return round(value, 5)      # with 5 decimals a rounded pi does not exceed pi


class Style:
    """Writes orders with common parameters: protocol, map, allowed deviation from a reached node in metres, action
    types for tasks with duration ("work") and without ("visit"), and seconds per time step."""

    def __init__(self, protocol, map_id, deviation, work, visit, seconds_per_step):
        self.protocol, self.map_id, self.deviation = protocol, map_id, deviation
        self.kinds = {"work": work, "visit": visit}
        self.seconds_per_step = seconds_per_step

    def action(self, node_action):
        parameters = [{"key": "task", "value": node_action.task}]
        if node_action.steps:
            parameters.append({"key": "seconds", "value": _number(node_action.steps * self.seconds_per_step)})
        return {"actionType": self.kinds[node_action.kind], "actionId": node_action.id, "blockingType": "HARD",
                "actionParameters": parameters}

    def node(self, route, i, released):
        node = route.nodes[i]
        position = {"x": _number(node.at[0]), "y": _number(node.at[1]),
                    "allowedDeviationXY": self.protocol.deviation(self.deviation), "mapId": self.map_id}
        if node.theta is not None:
            position["theta"] = _angle(node.theta)
        return {"nodeId": node.id, "sequenceId": 2 * i, "released": released, "nodePosition": position,
                "actions": [self.action(each) for each in node.node_actions]}

    def edge(self, route, i, released):
        """Returns the edge from node i to node i + 1."""
        begin, end = route.nodes[i].id, route.nodes[i + 1].id
        edge = {"edgeId": f"{begin}-{end}", "sequenceId": 2 * i + 1, "released": released, "startNodeId": begin,
                "endNodeId": end, "actions": []}
        if route.turns:
            edge |= {"orientation": 0.0, "orientationType": "TANGENTIAL", **self.protocol.turns_on_node}
        return edge

    def order(self, route, order_id, update, first, released, shown):
        """Returns an order that starts with node `first`, the end of the vehicle's current base. The new base ends with
        node `released`, the horizon with node `shown`."""
        return {"orderId": order_id, "orderUpdateId": update,
                "nodes": [self.node(route, i, i <= released) for i in range(first, shown + 1)],
                "edges": [self.edge(route, i, i < released) for i in range(first, shown)]}
