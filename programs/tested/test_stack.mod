MODULE test_stack
  ! A procedure test_... passes when it comes to its end; an error that nobody handles fails it.

  LOCAL PROC same(num is,num wanted)
    IF is<>wanted RAISE ERR_ARGVALERR;
  ENDPROC

  PROC test_six_boxes_are_a_layer()
    same layerOf(1),1;
    same layerOf(6),1;
    same layerOf(7),2;
  ENDPROC

  PROC test_three_boxes_are_a_row()
    same rowOf(3),1;
    same rowOf(4),2;
    same rowOf(7),1;
  ENDPROC

  PROC test_second_box_beside_first()
    VAR robtarget first;
    VAR robtarget second;
    first:=placeOf(1);
    second:=placeOf(2);
    same second.trans.x-first.trans.x,boxLength;
    same second.trans.y,first.trans.y;
  ENDPROC

  PROC test_second_layer_on_first()
    VAR robtarget below;
    VAR robtarget above;
    below:=placeOf(1);
    above:=placeOf(7);
    same above.trans.z-below.trans.z,boxHeight;
  ENDPROC

  PROC test_there_is_no_box_zero()
    VAR robtarget nowhere;
    nowhere:=placeOf(0);
    same 0,1;
  ERROR
    IF ERRNO=ERR_ARGVALERR AND nowhere.trans=[0,0,0] RETURN;
  ENDPROC

  PROC test_placing_counts()
    nPlaced:=0;
    place 1;
    same nPlaced,1;
  ENDPROC
ENDMODULE
