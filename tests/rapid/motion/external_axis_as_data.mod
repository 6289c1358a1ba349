! RAPID Instructions, robtarget: values of external axes that no station declares move nothing.
MODULE external_axis_as_data
  CONST jointtarget p:=[[0,0,0,0,30,0],[1500,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveAbsJ p,v500,fine,tool0;   ! note: M521
    MoveAbsJ p,v500,fine,tool0;
  ENDPROC
ENDMODULE
