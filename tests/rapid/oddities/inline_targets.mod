! Field practice, Aggregates: targets, speeds and zones written where they are used.
MODULE inline_targets
  PROC main()
    MoveJ [[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,z10,tool0;
    MoveL [[600,100,500],[0,0,1,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],
      [200,500,5000,1000],[FALSE,5,8,8,0.8,8,0.8],tool0\WObj:=wobj0;
    MoveL Offs([[600,100,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],0,-50,0),
      v200,fine,tool0;
    TPWrite ValToStr(CPos(\Tool:=tool0\WObj:=wobj0)=[0,0,0]);   ! -> FALSE
  ENDPROC
ENDMODULE
