// SPDX-License-Identifier: MIT
// The page: lists, buttons, pointers and the clock. A link is the viewer's text, the frame and the hash.
const TOGGLES = [["Interfering faces", 1], ["Contacts", 2], ["Z-list cells", 4], ["Leaves", 8], ["Wireframe", 16], ["Shadows", 32],
    ["Bars", 64], ["Text", 128]];
const KEYS = { ArrowRight: 16, ArrowLeft: 32, ArrowUp: 64, ArrowDown: 128, KeyX: 1, KeyZ: 2, KeyY: 2, Enter: 8, ShiftLeft: 4 };
const FRAME_MS = 1000 / 60, LATE_MAX = 3, PAGE_PIXELS = 700000, NO_STATE = {};
const START_HASH = location.hash; // kept before a scene writes its own
const at = (id) => document.getElementById(id);
const states = JSON.parse(at("states").textContent);

startModule(at("module").textContent).then(startPage, (error) => say("The engine does not start: " + error.message));

function say(words) {
    at("message").hidden = !words;
    at("message").textContent = words || "";
}

function judge(words, good) {
    at("verdict").hidden = !words;
    at("verdict").textContent = words || "";
    at("verdict").className = "verdict " + (good ? "good" : "bad");
}

function startPage(engine) {
    const { its } = engine, canvas = at("canvas"), context = canvas.getContext("2d");
    const view = { paused: false, keys: 0, dead: false, aim: NO_STATE, user: null, took: [], toggles: 0, scene: "" };

    const scene = () => engine.text(its.view_scene());
    const frame = () => its.view_step_count();
    const guard = (what) => (...given) => {
        try {
            return what(...given);
        } catch (error) {
            return say(error.message);
        }
    };

    function pause(paused) {
        view.paused = paused;
        its.view_pause(paused);
        at("play").textContent = paused ? "Play" : "Pause";
        if (paused) {
            writeLink();
        }
    }

    function began(aim) {
        Object.assign(view, { dead: false, aim: aim || NO_STATE, took: [] });
        say("");
        judge("");
        const known = states[scene()];
        view.untouched = known && !aim ? engine.link() : null;
        at("known").textContent = known ? `Boards end frame ${known.frame} of this scene in ${known.hash}.`
            : "The boards' tests have no state of this scene.";
        at("check").hidden = !known;
        if (view.scene !== scene()) { // toggles stay as they are, except those that suit the new scene
            toggle(its, view, (view.toggles & ~33) | its.view_usual());
            view.scene = scene();
        }
        at("name").textContent = scene();
        at("link").value = "";
        at("copy").disabled = scene() === "user";
        document.querySelectorAll("#list button").forEach((each) => each.setAttribute("aria-current", each.dataset.name === scene()));
        const current = document.querySelector("#list [aria-current=true]");
        if (current) {
            at("list").scrollTop = current.offsetTop - at("list").offsetTop - 60;
        }
    }

    const open = guard((name) => {
        engine.open(name);
        view.user = null;
        began();
        pause(false);
        history.replaceState(null, "", "#" + name);
    });

    const openFile = guard((name, buffer) => {
        const mesh = readMesh(name, buffer);
        engine.openMesh(mesh);
        view.user = mesh;
        began();
        pause(false);
    });

    const restart = guard(() => {
        if (view.user) {
            engine.openMesh(view.user);
        } else {
            engine.checked(its.view_restart(), scene());
        }
        began();
    });

    // LINK/FRAME/HASH, or only a scene's name.
    const follow = guard((hash) => {
        const [link, count, state, more] = decodeURIComponent(hash).split("/");
        if (count === undefined && engine.scenes.some(({ name }) => name === link)) {
            return open(link);
        }
        if (more !== undefined || !/^\d{1,7}$/.test(count || "") || !/^[0-9a-f]{16}$/.test(state || "")) {
            throw new Error("This link is cut or changed: its frame or its hash is missing.");
        }
        if (engine.follow(link) > Number(count)) {
            throw new Error("This link is changed: something is done after its last frame.");
        }
        view.user = null;
        began({ frame: Number(count), hash: state, link: true });
        return pause(false);
    });

    function writeLink() {
        if (scene() !== "user") {
            guard(() => {
                const hash = `#${engine.link()}/${frame()}/${engine.hash()}`;
                history.replaceState(null, "", hash);
                at("link").value = location.href;
            })();
        }
    }

    function compare() {
        const known = states[scene()], here = engine.hash();
        if (view.aim.frame === frame()) {
            const same = view.aim.hash === here;
            judge(`Frame ${frame()}: ${same ? "the hash of the link" : "not the hash of the link, which is " + view.aim.hash}.`, same);
            pause(true);
        } else if (known && known.frame === frame() && engine.link() === view.untouched) {
            const same = known.hash === here;
            judge(`Frame ${frame()}: ${same ? "the boards' hash" : "the boards have " + known.hash}.`, same);
        }
    }

    function step(call) {
        const steps = view.dead ? 0 : call();
        if (steps < 0) {
            view.dead = true;
            say(`The world stands still: ${engine.text(its.carom_result_text(steps))}.`);
        }
        if (steps > 0) {
            compare();
        }
        return steps;
    }

    function runTo(last) {
        pause(false);
        its.view_slow(1);
        while (frame() < last && step(its.view_frame) >= 0 && !view.dead) {
            if (view.paused) {
                break;
            }
        }
        its.view_slow(Number(at("slow").value));
        pause(true);
    }

    function size() {
        const box = canvas.getBoundingClientRect();
        const most = Math.min(PAGE_PIXELS, engine.pixelsMax);
        const scale = Math.min(devicePixelRatio, Math.sqrt(most / (box.width * box.height)));
        canvas.width = Math.max(1, Math.floor(box.width * scale));
        canvas.height = Math.max(1, Math.floor(box.height * scale));
        guard(() => engine.checked(its.page_size(canvas.width, canvas.height), "Picture"))();
    }

    function draw() {
        if (its.page_draw() >= 0) {
            context.putImageData(engine.picture(canvas.width, canvas.height), 0, 0);
        }
        at("count").textContent = frame();
        at("hash").textContent = engine.hash();
        at("pad").hidden = !its.page_is_game();
    }

    function bars() {
        view.took.forEach((took, i) => {
            const row = at("bars").children[i];
            row.children[1].firstChild.style.width = Math.min(100, (100 * took) / (view.took[engine.stageCount] || 1)) + "%";
            row.children[2].textContent = (took / 1000).toFixed(2) + " ms";
        });
    }

    // A browser's clock is coarse, so show means of many frames.
    function measure() {
        for (let i = 0; i < at("bars").children.length; i++) {
            view.took[i] = (view.took[i] || 0) * 0.95 + its.page_took(i) * 0.05;
        }
    }

    let before = performance.now(), due = 0, ticks = 0;
    function tick(now) {
        due = Math.min(due + now - before, LATE_MAX * FRAME_MS);
        before = now;
        for (; due >= FRAME_MS; due -= FRAME_MS) {
            if (step(its.view_frame) > 0) {
                measure();
            }
        }
        draw();
        if (++ticks % 15 === 0) {
            bars();
        }
        requestAnimationFrame(tick);
    }

    fillLists(engine, open, its, view);
    pointers(canvas, its);
    keys(its, view, pause);
    at("play").onclick = () => pause(!view.paused);
    at("single").onclick = () => {
        pause(true);
        step(its.view_single);
        writeLink();
    };
    at("restart").onclick = restart;
    at("home").onclick = () => its.view_home();
    at("slow").onchange = () => its.view_slow(Number(at("slow").value));
    at("check").onclick = () => {
        restart();
        runTo(states[scene()].frame);
    };
    at("copy").onclick = async () => {
        writeLink();
        at("link").select();
        await navigator.clipboard.writeText(at("link").value).catch(() => document.execCommand("copy"));
        at("copy").textContent = "Copied";
        setTimeout(() => (at("copy").textContent = "Copy"), 1500);
    };
    files(openFile);
    new ResizeObserver(size).observe(canvas);
    addEventListener("hashchange", () => follow(location.hash.slice(1)));
    at("scenes").open = innerWidth > 820;
    size();
    open(engine.scenes[0].name);
    if (START_HASH.length > 1) {
        follow(START_HASH.slice(1));
    }
    requestAnimationFrame(tick);
    document.body.dataset.ready = "1";
}

function toggle(its, view, toggles) {
    view.toggles = toggles;
    its.view_toggles(toggles);
    document.querySelectorAll("#toggles button").forEach((each) => each.setAttribute("aria-pressed", (toggles & each.dataset.bit) !== 0));
}

function fillLists(engine, open, its, view) {
    for (const { name, text } of engine.scenes) {
        if (name !== "user") {
            const row = document.createElement("li"), button = row.appendChild(document.createElement("button"));
            button.dataset.name = name;
            button.textContent = name;
            button.appendChild(document.createElement("small")).textContent = text;
            button.onclick = () => open(name);
            at("list").append(row);
        }
    }
    for (const [name, bit] of TOGGLES) {
        const button = at("toggles").appendChild(document.createElement("button"));
        button.textContent = name;
        button.dataset.bit = bit;
        button.onclick = () => toggle(its, view, view.toggles ^ bit);
    }
    const names = Array.from({ length: engine.stageCount }, (_, i) => engine.text(its.carom_stage_name(i)));
    for (const name of [...names, "all"]) {
        const row = at("bars").appendChild(document.createElement("div"));
        row.className = "bar";
        row.innerHTML = "<span></span><span><i></i></span><span></span>";
        row.firstChild.textContent = name;
    }
}

function pointers(canvas, its) {
    const down = new Map();
    let held = false, apart = 0;
    const place = (event) => {
        const box = canvas.getBoundingClientRect();
        return [((event.clientX - box.left) * canvas.width) / box.width, ((event.clientY - box.top) * canvas.height) / box.height]
            .map(Math.floor);
    };
    const distance = () => {
        const [a, b] = [...down.values()];
        return Math.hypot(a[0] - b[0], a[1] - b[1]);
    };
    canvas.onpointerdown = (event) => {
        canvas.setPointerCapture(event.pointerId);
        down.set(event.pointerId, place(event));
        if (down.size === 1) {
            held = event.button === 0 && its.view_grab(...place(event)) !== 0;
        } else {
            its.view_drop();
            held = false;
            apart = distance();
        }
    };
    canvas.onpointermove = (event) => {
        const old = down.get(event.pointerId), now = place(event);
        if (!old) {
            return;
        }
        down.set(event.pointerId, now);
        if (down.size === 2) {
            const steps = Math.trunc(Math.log(distance() / Math.max(apart, 1)) * 8);
            if (steps) {
                its.view_zoom(steps);
                apart = distance();
            }
        } else if (held) {
            its.view_drag(...now);
        } else {
            (event.shiftKey || event.buttons & 6 ? its.view_pan : its.view_orbit)(now[0] - old[0], now[1] - old[1]);
        }
    };
    canvas.onpointerup = canvas.onpointercancel = (event) => {
        down.delete(event.pointerId);
        if (held) {
            its.view_drop();
        }
        held = false;
    };
    canvas.oncontextmenu = (event) => event.preventDefault();
    canvas.addEventListener("wheel", (event) => {
        event.preventDefault();
        its.view_zoom(event.deltaY < 0 ? 1 : -1);
    }, { passive: false });
}

function keys(its, view, pause) {
    const hold = (bit, on) => its.view_keys((view.keys = on ? view.keys | bit : view.keys & ~bit));
    const key = (on) => (event) => {
        if (event.target.matches("input, select, summary, button, [contenteditable]") || event.ctrlKey || event.metaKey || event.repeat) {
            return;
        }
        if (KEYS[event.code]) {
            event.preventDefault();
            hold(KEYS[event.code], on);
        } else if (on && event.code === "Space") {
            event.preventDefault();
            pause(!view.paused);
        } else if (on && event.code === "KeyS") {
            at("single").click();
        }
    };
    addEventListener("keydown", key(true));
    addEventListener("keyup", key(false));
    addEventListener("blur", () => view.keys && hold(view.keys, false));
    document.querySelectorAll("[data-key]").forEach((each) => {
        each.onpointerdown = () => hold(Number(each.dataset.key), true);
        each.onpointerup = each.onpointerleave = each.onpointercancel = () =>
            view.keys & Number(each.dataset.key) && hold(Number(each.dataset.key), false);
    });
}

function files(openFile) {
    const read = async (file) => file && openFile(file.name, await file.arrayBuffer());
    at("file").onchange = (event) => read(event.target.files[0]);
    addEventListener("dragover", (event) => {
        event.preventDefault();
        document.body.classList.add("drop");
    });
    addEventListener("dragleave", () => document.body.classList.remove("drop"));
    addEventListener("drop", (event) => {
        event.preventDefault();
        document.body.classList.remove("drop");
        read(event.dataTransfer.files[0]);
    });
}
