! Field practice, Instructions and aggregates over several lines.
MODULE several_lines
  CONST robtarget pHome:=[
    [600,0,500],          ! position
    [0,0,1,0],
    [0,0,0,0],
    [9E9,9E9,9E9,
     9E9,9E9,9E9]
  ];

  PROC main()
    MoveJ
      pHome,
      v500\T:=2,
      fine,
      tool0
      \WObj:=wobj0;
    IF pHome.trans.x=600
      AND pHome.trans.z=500
    THEN
      TPWrite "at "       ! -> at 600
        +ValToStr(pHome.trans.x);
    ENDIF
  ENDPROC
ENDMODULE
