"""Messages that no page of ours sends."""

import json

from planner import ServeTest
from websocket import BINARY, Closed

DEEP = "[" * 200_000 + "]" * 200_000


class Requests(ServeTest):
    def setUp(self):
        super().setUp()
        self.write_store()
        self.server = self.serve()
        self.tab = self.open(self.server)

    def test_without_a_meaning_are_ignored(self):
        for text in (
            "",
            "null",
            "[]",
            '"a"',
            "{",
            "{}",
            '{"do": "undo"}',
            DEEP,
            '{"id": ' + DEEP + "}",
            '{"id": 1, "id": 2}',
        ):
            self.tab.socket.send(text)
        self.assertEqual(self.tab.ask("find", text="x")["hits"][0]["id"], "x")

    def test_with_wrong_values_are_answered(self):
        one = {"path": "/name", "before": "Aisle", "after": "Nave"}
        for do, keys in (
            ("fly", {}),
            ("edit", {}),
            ("edit", {"label": "a", "ops": {}}),
            ("edit", {"label": "a", "ops": [1]}),
            ("edit", {"label": "a", "ops": [{"path": 1}]}),
            ("edit", {"label": "a", "ops": [{"path": "/name"}]}),
            ("edit", {"label": 1, "ops": [one]}),
            ("edit", {"label": "a", "ops": [{**one, "path": "name"}]}),
            ("edit", {"label": "a", "ops": [{**one, "path": "/fixtures/-1"}]}),
            ("edit", {"label": "a", "ops": [{**one, "path": "/fixtures/99999999999999999999"}]}),
            ("edit", {"label": "a", "ops": [{**one, "path": "", "after": []}]}),
            ("edit", {"label": "a", "ops": [one], "join": "yes"}),
            ("go", {}),
            ("go", {"position": -1}),
            ("go", {"position": 10**30}),
            ("go", {"position": 1}),
            ("dissolve", {"label": "a", "path": "/fixtures/0"}),
            ("dissolve", {"label": "a", "path": "/fixtures/99"}),
            ("details", {"path": "/fixtures/~"}),
            ("details", {"path": "/fixtures/00"}),
            ("details", {"path": "/fixtures/99999999999999999999"}),
            ("device", {"kind": "label", "index": 10**15}),
            ("device", {"kind": 1, "index": 0}),
            ("find", {"text": None}),
        ):
            with self.subTest(do=do, keys=keys):
                self.assertIn("error", self.tab.ask(do, **keys))
        self.assertEqual(self.tab.changes(), [])
        self.assertEqual(self.tab.set("/name", "Nave")["revision"], 2)

    def test_for_units_with_wrong_values_are_answered(self):
        place = {"action": "place", "label": "a", "type": "t", "position": [4, 3, 2.5]}
        change = {"action": "change", "label": "a"}
        for do, keys in (
            ("mount", {}),
            ("mount", {"at": 1}),
            ("mount", {"at": [1]}),
            ("mount", {"at": ["a", 2]}),
            ("mount", {"at": [1, 1], "unit": 99}),
            ("mount", {"at": [1, 1], "unit": -1}),
            ("mount", {"at": [1, 1], "type": "none"}),
            ("drag", {"at": [1, 1], "unit": 0}),
            ("unit", {}),
            ("unit", {"action": "fly", "label": "a", "index": 0, "on": True}),
            ("unit", {**place, "position": [1, 2]}),
            ("unit", {**place, "position": [1, 2, None]}),
            ("unit", {**place, "type": "none"}),
            ("unit", {**place, "as": "selected"}),
            ("unit", {**place, "axis": [0, 0, 0]}),
            ("unit", {**place, "roll_deg": 1e9}),
            ("unit", {**place, "power": 0}),
            ("unit", {**place, "power": 1001}),
            ("unit", change),
            ("unit", {**change, "index": 1}),
            ("unit", {**change, "each": 1}),
            ("unit", {**change, "each": [{"index": 0, "id": "of another"}]}),
            ("unit", {"action": "pin", "label": "a", "index": 0}),
            ("unit", {"action": "pin", "label": "a", "index": 0, "on": 1}),
        ):
            with self.subTest(do=do, keys=keys):
                self.assertIn("error", self.tab.ask(do, **keys))
        self.assertEqual(self.tab.changes(), [])
        self.assertEqual(self.tab.ask("unit", **place)["units"], ["U1"])

    def test_for_many_units_at_once_do_not_hold_the_others_up(self):
        each = [{"type": "t", "position": [4, 3, 2.5]}] * 3000
        answer = self.tab.ask("unit", action="place", label="Place", each=each)
        self.assertEqual(answer["units"][-1], "U3000")

    def test_of_a_closed_page_hold_no_light(self):
        holding = self.open(self.server)
        self.assertNotIn("error", holding.ask("hold"))
        self.assertNotIn("error", self.tab.ask("release"))
        holding.close()
        self.assertNotIn("error", self.tab.ask("hold"))
        self.assertNotIn("error", self.tab.ask("release"))

    def test_of_many_levels_are_refused(self):
        deep = json.loads("[" * 97 + "]" * 97)
        self.assertNotIn("error", self.tab.edit({"path": "/x", "after": deep}))
        self.assertIn("error", self.tab.edit({"path": "/x/0/0/0", "after": deep}))
        self.assertEqual(self.tab.revision, 2)

    def test_in_binary_close_the_page(self):
        self.tab.socket.send(b"{}", BINARY)
        with self.assertRaises(Closed) as closed:
            while True:
                self.tab.read()
        self.assertEqual(closed.exception.code, 1003)
        self.open(self.server)
