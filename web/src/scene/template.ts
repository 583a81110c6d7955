/** What a scene of one's own begins with. */
export const newScene = `<world>
    <window width="800" height="600"/>
    <camera>
        <position x="4" y="3" z="6"/>
        <lookAt x="0" y="0.6" z="0"/>
        <projection fov="45" near="0.1" far="100"/>
    </camera>
    <lights>
        <light type="directional" dirX="0.4" dirY="1" dirZ="0.6"/>
    </lights>
    <group>
        <models>
            <model file="plane_8_8.3d">
                <color> <diffuse R="52" G="96" B="128"/> </color>
            </model>
        </models>
    </group>
    <group>
        <transform> <translate y="1"/> <rotate time="12" y="1"/> </transform>
        <models>
            <model file="torus_1_0.4_48_24.3d">
                <color>
                    <diffuse R="230" G="150" B="60"/>
                    <specular R="255" G="255" B="255"/>
                    <shininess value="64"/>
                </color>
            </model>
        </models>
    </group>
</world>
`;
