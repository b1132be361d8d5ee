# SPDX-License-Identifier: MIT
"""Orders of VDA 5050 from a route: what of it is released, the base, and what comes then, the horizon."""


def _number(value):
    return round(value, 6)


def _angle(value):
    return round(value, 5)      # so that it does not exceed pi


class Style:
    """How orders are written: protocol, map, metres a vehicle may be off a node that it has reached, names of
    the actions for work and visits, how long a step of work takes."""

    def __init__(self, protocol, map_id, deviation, work, visit, seconds_per_step):
        self.protocol, self.map_id, self.deviation = protocol, map_id, deviation
        self.kinds = {"work": work, "visit": visit}
        self.seconds_per_step = seconds_per_step

    def action(self, work):
        parameters = [{"key": "task", "value": work.task}]
        if work.steps:
            parameters.append({"key": "seconds", "value": _number(work.steps * self.seconds_per_step)})
        return {"actionType": self.kinds[work.kind], "actionId": work.id, "blockingType": "HARD",
                "actionParameters": parameters}

    def node(self, route, i, released):
        node = route.nodes[i]
        position = {"x": _number(node.at[0]), "y": _number(node.at[1]),
                    "allowedDeviationXY": self.protocol.deviation(self.deviation), "mapId": self.map_id}
        if node.theta is not None:
            position["theta"] = _angle(node.theta)
        return {"nodeId": node.id, "sequenceId": 2 * i, "released": released, "nodePosition": position,
                "actions": [self.action(work) for work in node.works]}

    def edge(self, route, i, released):
        """From node i to the next."""
        begin, end = route.nodes[i].id, route.nodes[i + 1].id
        edge = {"edgeId": f"{begin}-{end}", "sequenceId": 2 * i + 1, "released": released, "startNodeId": begin,
                "endNodeId": end, "actions": []}
        if route.turns:
            edge |= {"orientation": 0.0, "orientationType": "TANGENTIAL", **self.protocol.turns_on_node}
        return edge

    def order(self, route, order_id, update, first, released, shown):
        """From node `first`, where the vehicle's base ends so far, the base to `released`, the horizon to
        `shown`."""
        return {"orderId": order_id, "orderUpdateId": update,
                "nodes": [self.node(route, i, i <= released) for i in range(first, shown + 1)],
                "edges": [self.edge(route, i, i < released) for i in range(first, shown)]}
