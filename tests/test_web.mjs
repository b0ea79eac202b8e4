// SPDX-License-Identifier: MIT
// The page of `make web` in a headless Chromium: node tests/test_web.mjs [FOLDER FOR PICTURES]. TAP.
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const ROOT = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const { chromium } = createRequire(path.join(ROOT, "build/npm/web/"))("playwright-core");
const PAGE = pathToFileURL(path.join(ROOT, "out/web/index.html")).href;
const GOLDEN = { scene: "head", frame: 600, hash: "b57fdd286fde9cb7" }; // from
                                                                        // tests/bench_scenes.csv,
                                                                        // measured on a Cortex-M3
const FRAMES = 12;
const CUBE = `v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n`;
const pictures = process.argv[2];

let count = 0, failed = 0;
function check(name, ok, seen) {
    failed += !ok;
    console.log(`${ok ? "ok" : "not ok"} ${++count} - web/${name}${ok ? "" : " " + JSON.stringify(seen)}`);
}

const browser = await chromium.launch({
    executablePath: execFileSync("sh", ["-c", "command -v chromium"]).toString().trim(),
    args: ["--no-sandbox", "--disable-gpu"],
});
const errors = [];

async function open(hash = "", options = {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
    const page = await context.newPage();
    page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
    page.on("pageerror", (error) => errors.push(error.message));
    page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || errors.push(request.url()));
    await page.goto(PAGE + hash);
    await page.waitForSelector("body[data-ready]");
    return page;
}

const frame = async (page) => Number(await page.textContent("#count"));
const text = (page, id) => page.textContent("#" + id);

// Wait until the last event is in the picture.
const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

// Pause, then press Step until the frame is reached. On a busy machine the page may have played past it: then it begins again.
async function stepTo(page, last) {
    await page.evaluate(async (last) => {
        const count = () => Number(document.getElementById("count").textContent);
        const button = (id) => document.getElementById(id);
        button("single").click();
        for (;;) {
            await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
            if (count() === last) {
                break;
            }
            button(count() > last ? "restart" : "single").click();
        }
    }, last);
    return { frame: await frame(page), hash: await text(page, "hash") };
}

// The middle of the brown pixels of the picture, which are the moving body: column and row from the top
// left, 0 .. 1.
const bodyPlace = (page) => page.evaluate(() => {
    const canvas = document.getElementById("canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let column = 0, row = 0, pixels = 0;
    for (let i = 0; i < data.length; i += 4) {
        if (data[i] > data[i + 1] + 16 && data[i + 1] >= data[i + 2]) {
            column += (i / 4) % canvas.width;
            row += Math.floor(i / 4 / canvas.width);
            pixels++;
        }
    }
    return pixels ? [column / pixels / canvas.width, row / pixels / canvas.height] : [-1, -1];
});
const bodyRow = async (page) => (await bodyPlace(page))[1];

async function runs() {
    const page = await open();
    const first = await frame(page);
    await page.waitForFunction((n) => Number(document.getElementById("count").textContent) > n, first + 5).catch(() => 0);
    check("frames advance", (await frame(page)) > first + 5, await frame(page));
    await page.click("#check");
    await page.waitForFunction((n) => Number(document.getElementById("count").textContent) === n, GOLDEN.frame, { timeout: 60000 });
    check("the boards' state", (await text(page, "hash")) === GOLDEN.hash, await text(page, "hash"));
    check("the page says so", /the boards' hash/.test(await text(page, "verdict")), await text(page, "verdict"));
    const listed = await page.$$eval("#list button", (all) => all.map((each) => each.dataset.name));
    check("scenes are listed", ["head", "car", "walker"].every((name) => listed.includes(name)), listed);
    await page.context().close();
}

// Run each scene of the page for some frames: no message, and the host's state.
async function scenes() {
    const page = await open(), wrong = [], all = await page.$$eval("#list button", (each) => each.map(({ dataset }) => dataset.name));
    for (const name of all.filter((each) => !each.startsWith("growth"))) {
        const seen = await page.evaluate(async ([name, frames]) => {
            const at = (id) => document.getElementById(id);
            document.querySelector(`#list [data-name="${name}"]`).click();
            for (let i = 0; i < frames; i++) {
                at("single").click();
            }
            await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
            return [at("count").textContent, at("hash").textContent, at("message").textContent].join(" ").trim();
        }, [name, FRAMES]);
        const said = execFileSync(path.join(ROOT, "build/host/head.elf"), ["scene=" + name, "frames=" + FRAMES]).toString();
        if (seen !== `${FRAMES} ${/^hash (\w+)$/m.exec(said)[1]}`) {
            wrong.push([name, seen]);
        }
    }
    check(`${all.length} scenes have the host's states`, all.length > 20 && wrong.length === 0, wrong);
    await page.context().close();
}

// Fingers: one turns the view, two move the camera closer.
async function touches() {
    const page = await open("#box", { viewport: { width: 360, height: 740 }, hasTouch: true });
    const client = await page.context().newCDPSession(page), box = await page.locator("#canvas").boundingBox();
    const fingers = async (type, ...places) => {
        await client.send("Input.dispatchTouchEvent", { type, touchPoints: places.map(([x, y], id) =>
            ({ id, x: box.x + x * box.width, y: box.y + y * box.height })) });
        await drawn(page);
    };
    const look = () => page.evaluate(() => {
        const canvas = document.getElementById("canvas"), { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        const pixels = new Uint32Array(data.buffer), brown = (i) => data[i] > data[i + 1] + 16 && data[i + 1] >= data[i + 2];
        return { body: pixels.filter((_, i) => brown(4 * i)).length, sum: pixels.reduce((sum, rgb, i) => (sum + rgb * (i % 997)) % 1e9, 0) };
    });
    await stepTo(page, 60);
    const still = await look();
    await fingers("touchStart", [0.2, 0.1]);
    await fingers("touchMove", [0.4, 0.12]);
    await fingers("touchEnd");
    const turned = await look();
    check("a finger turns the view", turned.sum !== still.sum && (await frame(page)) === 60, [still, turned]);
    await page.click("#home");
    await drawn(page);
    check("the view is reset", (await look()).sum === still.sum, await look());
    await fingers("touchStart", [0.3, 0.1], [0.5, 0.1]);
    await fingers("touchMove", [0.2, 0.1], [0.7, 0.1]);
    await fingers("touchEnd");
    const near = await look();
    check("two fingers come nearer", near.body > 1.3 * still.body, [still.body, near.body]);
    await page.context().close();
}

const drop = (page, name, words) => page.setInputFiles("#file", { name, mimeType: "text/plain", buffer: Buffer.from(words) });

async function meshFalls() {
    const ends = [];
    for (let run = 0; run < 2; run++) {
        const page = await open();
        await page.click("#play");
        await drop(page, "cube.obj", CUBE);
        await page.waitForFunction(() => document.getElementById("name").textContent === "user");
        const early = await stepTo(page, 1), high = await bodyRow(page);
        const late = await stepTo(page, 60), low = await bodyRow(page);
        check("a mesh falls, run " + run, high >= 0 && early.frame < 30 && low > high + 0.02, [early, high, late, low]);
        ends.push(late);
        await page.context().close();
    }
    check("and both times in the same way", ends[0].frame === 60 && ends[0].hash === ends[1].hash && ends[0].frame === ends[1].frame, ends);
}

async function badMeshes() {
    const page = await open();
    for (const [name, words, says] of [["open.obj", CUBE.split("f 4 1")[0], /open: 4 edges/], ["empty.obj", "# nothing\n", /no faces/],
        ["index.obj", CUBE + "f 1 2 99\n", /not there/], ["word.obj", CUBE.replace("v 1 -1", "v one -1"), /not three numbers/]]) {
        await drop(page, name, words);
        await page.waitForFunction(() => !document.getElementById("message").hidden, null, { timeout: 20000 }).catch(() => 0);
        check(name + " is refused", says.test(await text(page, "message")), await text(page, "message"));
        await page.click("#restart");
    }
    await page.context().close();
}

async function links() {
    const page = await open("#box");
    const made = await stepTo(page, 90);
    const link = await page.inputValue("#link"), hash = link.slice(link.indexOf("#"));
    check("a link is made", hash.endsWith(`/${made.frame}/${made.hash}`), link);
    await page.context().close();
    const other = await open(hash);
    await other.waitForFunction(() => !document.getElementById("verdict").hidden, null, { timeout: 20000 });
    check("opened, it is the same", (await text(other, "hash")) === made.hash && /the hash of the link/.test(await text(other, "verdict")) &&
        (await frame(other)) === made.frame, await text(other, "verdict"));
    await other.context().close();
    for (const [name, bad] of [["cut", hash.slice(0, -3)], ["cut short", hash.split("/")[0] + "/1"], ["of no scene", "#nothing/5/0123456789abcdef"]]) {
        const refused = await open(bad);
        check("a link " + name + " is refused", /link/i.test(await text(refused, "message")), await text(refused, "message"));
        await refused.context().close();
    }
    const changed = await open(hash.replace(/.$/, (last) => (last === "0" ? "1" : "0")));
    await changed.waitForFunction(() => !document.getElementById("verdict").hidden, null, { timeout: 20000 });
    check("a changed hash is seen", /not the hash/.test(await text(changed, "verdict")), await text(changed, "verdict"));
    await changed.context().close();
}

// A hand takes the box, pulls it aside and lets go; the link has all of that.
async function throws() {
    const free = await open("#box"), alone = await stepTo(free, 120);
    await free.context().close();
    const page = await open("#box");
    await stepTo(page, 30);
    const [x, y] = await bodyPlace(page), box = await page.locator("#canvas").boundingBox();
    const place = (aside) => [box.x + x * box.width + aside, box.y + y * box.height - aside];
    await page.mouse.move(...place(0));
    await page.mouse.down();
    for (let i = 1; i <= 6; i++) {
        await page.mouse.move(...place(12 * i));
        await stepTo(page, (await frame(page)) + 2);
    }
    await page.mouse.up();
    const thrown = await stepTo(page, 120), link = await page.inputValue("#link");
    check("a hand moves a body", x > 0 && thrown.frame === alone.frame && thrown.hash !== alone.hash, [x, y, thrown, alone]);
    await page.context().close();
    const other = await open(link.slice(link.indexOf("#")));
    await other.waitForFunction(() => !document.getElementById("verdict").hidden, null, { timeout: 20000 });
    check("the link does it again", (await text(other, "hash")) === thrown.hash && (await frame(other)) === thrown.frame,
        [await text(other, "verdict"), thrown]);
    await other.context().close();
}

// The smallest contrast of text on its background, and the colour of the page.
const colours = (page) => page.evaluate(() => {
    const parts = (colour) => colour.match(/[\d.]+/g).map(Number);
    const light = (colour) => parts(colour).slice(0, 3).map((c) => c / 255).map((c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
        .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
    const behind = (each) => {
        const colour = getComputedStyle(each).backgroundColor;
        return (parts(colour)[3] ?? 1) === 0 && each.parentElement ? behind(each.parentElement) : colour;
    };
    let least = 99, where = "";
    for (const each of document.querySelectorAll("h1, h2, p, button, summary, small, output, label, select, .bar span")) {
        if (each.textContent.trim()) {
            const [a, b] = [light(getComputedStyle(each).color), light(behind(each))].sort((x, y) => y - x);
            if ((a + 0.05) / (b + 0.05) < least) {
                [least, where] = [(a + 0.05) / (b + 0.05), each.outerHTML.slice(0, 60)];
            }
        }
    }
    return { least, where, back: getComputedStyle(document.body).backgroundColor };
});

async function looks() {
    const backs = [];
    for (const colorScheme of ["light", "dark"]) {
        for (const [width, height] of [[1280, 800], [360, 740]]) {
            const page = await open("#car", { viewport: { width, height }, colorScheme, hasTouch: width < 500 });
            await page.waitForTimeout(700);
            const { least, where, back } = await colours(page);
            const wide = await page.evaluate(() => document.documentElement.scrollWidth);
            check(`${width} ${colorScheme}: text can be read`, least >= 4.5, [least, where]);
            check(`${width} ${colorScheme}: nothing to scroll aside`, wide <= width, wide);
            const names = await page.$$eval("button, select, input", (all) => all.filter((each) =>
                !each.textContent.trim() && !each.ariaLabel && !each.labels?.length).map((each) => each.outerHTML));
            check(`${width} ${colorScheme}: all controls have names`, names.length === 0, names);
            backs.push(back);
            if (pictures) {
                await page.screenshot({ path: path.join(pictures, `${colorScheme}-${width}.png`) });
                await page.screenshot({ path: path.join(pictures, `${colorScheme}-${width}-all.png`), fullPage: true });
            }
            await page.context().close();
        }
    }
    check("light and dark differ", new Set(backs).size === 2, backs);
}

for (const part of [runs, scenes, touches, meshFalls, badMeshes, links, throws, looks]) {
    await part().catch((error) => check(part.name, false, error.message.slice(0, 300)));
}
check("no error, no request", errors.length === 0, errors);
await browser.close();
process.exitCode = failed > 0 ? 1 : 0;
